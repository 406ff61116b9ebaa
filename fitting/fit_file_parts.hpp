#pragma once

#include <string>
#include <utility>
#include <vector>

#include "files/csv.hpp"
#include "files/yaml.hpp"
#include "fitting/fit_file.hpp"

// The parts of a fit file's entries, each read from its own node.
namespace shakebed::fitting {

/// A sequence's elements, or the node itself; refuses an empty sequence.
std::vector<files::YamlNode> one_or_more(const files::YamlNode& node);

/// The meaning of one of `words`; an unknown word is refused with the known ones.
template <class Word>
Word word_of(const files::YamlNode& node, const std::vector<std::pair<std::string, Word>>& words) {
  const std::string got = node.as_string();
  std::vector<std::string> known;
  for (const auto& [name, word] : words) {
    if (name == got) return word;
    known.push_back(name);
  }
  std::string list;
  for (const auto& name : known) list += (list.empty() ? "" : ", ") + name;
  const auto nearest = files::nearest_word(got, known);
  throw node.error("expected one of " + list + "; got " + got +
                   (nearest ? " (did you mean " + *nearest + "?)" : ""));
}

double positive(const files::YamlNode& node);
double share(const files::YamlNode& node);  ///< above 0, at most 1

std::vector<Filter> read_select(const files::YamlNode& node);
Exclusion read_exclusion(const files::YamlNode& node);  ///< {W: [1.3, 1.5], because: "..."}
/// Columns and bounds, or `{study: key}`: the range of W of an earlier study, from a table with
/// columns key, W_from, W_to and provenance. A range that is not `given` is uncertain, and its ends
/// are tried times 0.7 and 1.4.
RangeSpecification read_range(const files::YamlNode& node, const files::CsvTable* studies);
Model read_model(const files::YamlNode& node);
Reference read_reference(const files::YamlNode& node, const Model& model);

}  // namespace shakebed::fitting
