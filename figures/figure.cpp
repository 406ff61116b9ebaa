#include "figures/figure.hpp"

#include <array>

#include "figures/gnuplot.hpp"
#include "figures/printed_table.hpp"
#include "files/atomic_file.hpp"

namespace shakebed::figures {
namespace {

namespace fs = std::filesystem;

constexpr std::array picture_endings{".svg", ".png"};
constexpr std::array table_endings{".txt", ".md"};

/// A part and the file it is written to.
struct WrittenPart {
  files::CsvTable table;
  fs::path file;
};

std::vector<WrittenPart> write_parts(const Specification& specification, const Tables& tables,
                                     const fs::path& stem) {
  std::vector<WrittenPart> parts;
  for (const auto& part : specification.parts) {
    auto table = assemble(part, tables);
    table.provenance.insert(table.provenance.begin(),
                            "figure: " + specification.id + ", " + specification.title);
    const auto ending = parts.empty() ? ".csv" : "-" + part.name + ".csv";
    parts.push_back({std::move(table), fs::path(stem).concat(ending)});
  }
  for (const auto& part : parts) part.table.write(part.file);
  return parts;
}

void draw_picture(const Specification& specification, const std::vector<WrittenPart>& parts,
                  const fs::path& stem) {
  std::vector<ScriptTable> for_script;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for_script.push_back({specification.parts[i].name, parts[i].file, parts[i].table.columns()});
  }
  draw(specification.script, for_script, specification.size, stem);
}

void print_table(const Specification& specification, const std::vector<WrittenPart>& parts,
                 const fs::path& stem) {
  std::vector<files::CsvTable> tables;
  for (const auto& part : parts) tables.push_back(part.table);
  files::write_text(fs::path(stem).concat(".txt"), as_text(specification, tables));
  files::write_text(fs::path(stem).concat(".md"), as_markdown(specification, tables));
}

}  // namespace

std::vector<fs::path> make_figure(const Specification& specification, const Tables& tables,
                                  const fs::path& folder) {
  const auto stem = folder / specification.id;
  const auto parts = write_parts(specification, tables, stem);
  std::vector<fs::path> written;
  for (const auto& part : parts) written.push_back(part.file);
  if (specification.is_picture()) {
    draw_picture(specification, parts, stem);
  } else {
    print_table(specification, parts, stem);
  }
  for (const char* ending : specification.is_picture() ? picture_endings : table_endings) {
    written.push_back(fs::path(stem).concat(ending));
  }
  return written;
}

}  // namespace shakebed::figures
