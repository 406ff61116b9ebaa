#include "figures/manifest.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <memory>

#include "files/atomic_file.hpp"
#include "files/error.hpp"
#include "files/yaml.hpp"

namespace shakebed::figures {
namespace {

using files::YamlNode;

Tolerance read_tolerance(const YamlNode& node) {
  node.refuse_unknown_keys({"absolute", "relative", "why"});
  if (node.has("absolute") == node.has("relative")) {
    throw node.error("a tolerance is either 'absolute' or 'relative'");
  }
  const bool relative = node.has("relative");
  const auto value = node.at(relative ? "relative" : "absolute");
  if (!(value.as_double() > 0)) throw value.error("a tolerance is positive");
  return {relative ? Tolerance::Kind::relative : Tolerance::Kind::absolute, value.as_double(),
          node.at("why").as_string()};
}

OurValue read_our_value(const YamlNode& node) {
  node.refuse_unknown_keys({"table", "row", "column"});
  OurValue ours{node.at("table").as_string(), {}, node.at("column").as_string()};
  for (const auto& [column, word] : node.at("row").items()) {
    ours.row.emplace_back(column, word.as_string());
  }
  return ours;
}

ReferenceValue read_value(const YamlNode& node) {
  node.refuse_unknown_keys({"name", "value", "unit", "provenance", "source", "ours", "tolerance"});
  ReferenceValue value;
  value.where = node.where();
  value.name = node.at("name").as_string();
  value.provenance = node.at("provenance").as_string();
  value.source = node.at("source").as_string();
  static const std::vector<std::string> known{"given", "derived", "inferred", "not_given"};
  if (std::find(known.begin(), known.end(), value.provenance) == known.end()) {
    throw node.at("provenance").error("expected given, derived, inferred or not_given");
  }
  if (node.has("value") == (value.provenance == "not_given")) {
    throw node.error("expected a value, or 'provenance: not_given' without one");
  }
  if (node.has("value")) {
    value.value = node.at("value").as_double();
    value.unit = node.at("unit").as_string();
  }
  if (const auto ours = node.find("ours")) value.ours = read_our_value(*ours);
  if (const auto tolerance = node.find("tolerance")) value.tolerance = read_tolerance(*tolerance);
  if (value.ours.has_value() != value.tolerance.has_value() || (value.ours && !value.value)) {
    throw node.error("'ours' and 'tolerance' belong together, beside a value");
  }
  return value;
}

Entry read_entry(const std::string& id, const YamlNode& node,
                 const std::map<std::string, std::string>& papers) {
  node.refuse_unknown_keys({"paper", "item", "what", "reference", "claims"});
  Entry entry;
  entry.id = id;
  entry.paper = node.at("paper").as_string();
  if (!papers.contains(entry.paper)) {
    throw node.at("paper").error("'" + entry.paper + "' is not among 'papers'");
  }
  entry.item = node.at("item").as_string();
  entry.what = node.at("what").as_string();
  if (const auto values = node.find("reference")) {
    for (const auto& value : values->elements()) entry.values.push_back(read_value(value));
  }
  if (const auto claims = node.find("claims")) {
    for (const auto& claim : claims->elements()) {
      entry.claims.push_back(fitting::claims::read_claim(claim));
      const auto& name = entry.claims.back().id;
      const auto same = [&](const auto& other) { return other.id == name; };
      if (std::count_if(entry.claims.begin(), entry.claims.end(), same) > 1) {
        throw claim.error("this entry has two claims '" + name + "'");
      }
    }
  }
  return entry;
}

ShippedFile read_shipped_file(const std::string& path, const YamlNode& node) {
  node.refuse_unknown_keys({"sha256", "made_by"});
  const auto hash = node.at("sha256").as_string();
  if (hash.size() != 64 || hash.find_first_not_of("0123456789abcdef") != std::string::npos) {
    throw node.at("sha256").error("expected 64 lower-case hexadecimal digits");
  }
  return {path, hash, node.at("made_by").as_string()};
}

}  // namespace

const Entry& Manifest::entry(const std::string& id) const {
  std::vector<std::string> known;
  for (const auto& candidate : entries) {
    if (candidate.id == id) return candidate;
    known.push_back(candidate.id);
  }
  const auto near = files::nearest_word(id, known);
  throw files::bad_input(file.string(), "has no entry '" + id + "'" +
                                            (near ? "; the nearest is '" + *near + "'" : ""));
}

Manifest read_manifest(const std::filesystem::path& file) {
  const auto root = YamlNode::load_file(file);
  root.refuse_unknown_keys({"manifest", "papers", "entries", "files"});
  if (root.at("manifest").as_integer() != 1) {
    throw root.at("manifest").error("this program reads manifests of schema 1");
  }
  Manifest manifest;
  manifest.file = file;
  for (const auto& [key, paper] : root.at("papers").items()) {
    paper.refuse_unknown_keys({"title", "doi", "shapes_only"});
    manifest.papers[key] = paper.at("doi").as_string();
    if (const auto profiles = paper.find("shapes_only")) {
      for (const auto& one : profiles->elements()) {
        manifest.shapes_only[key].push_back(one.as_string());
      }
    }
  }
  for (const auto& [id, entry] : root.at("entries").items()) {
    manifest.entries.push_back(read_entry(id, entry, manifest.papers));
  }
  if (const auto shipped = root.find("files")) {
    for (const auto& [path, node] : shipped->items()) {
      manifest.files.push_back(read_shipped_file(path, node));
    }
  }
  return manifest;
}

std::string sha256_of(const std::filesystem::path& file) {
  const auto bytes = files::read_text(file);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw files::failed(file.string(), "OpenSSL could not compute its SHA-256");
  }
  static constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    text += digits[digest[i] >> 4];
    text += digits[digest[i] & 15];
  }
  return text;
}

}  // namespace shakebed::figures
