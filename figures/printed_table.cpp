#include "figures/printed_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace shakebed::figures {
namespace {

using files::CsvTable;

/// A part as it is printed: header and rows of words, columns of numbers to the right.
struct Grid {
  std::vector<std::vector<std::string>> lines;
  std::vector<bool> right;
};

std::string rounded(double value, int digits) {
  if (std::isnan(value)) return "-";
  char text[64];
  // 1.8e+02 reads worse than 180, whose last digit is then one too many.
  const bool whole = std::abs(value) >= std::pow(10.0, digits) && std::abs(value) < 1e6;
  if (whole) {
    std::snprintf(text, sizeof text, "%.0f", value);
  } else {
    std::snprintf(text, sizeof text, "%#.*g", digits, value);
  }
  std::string result = text;
  if (result.ends_with('.')) result.pop_back();
  return result;
}

std::string heading(const files::CsvColumn& column) {
  const bool plain = column.unit.empty() || column.unit == "1";
  return plain ? column.name : column.name + " [" + column.unit + "]";
}

std::optional<int> digits_of(const Part& part, std::size_t column) {
  if (column >= part.columns.size()) return std::nullopt;
  const auto* copied = std::get_if<CopiedColumn>(&part.columns[column].kind);
  return copied != nullptr ? copied->digits : std::nullopt;
}

Grid grid_of(const Part& part, const CsvTable& table) {
  Grid grid;
  grid.lines.emplace_back();
  for (std::size_t column = 0; column < table.columns().size(); ++column) {
    grid.lines.front().push_back(heading(table.columns()[column]));
    grid.right.push_back(digits_of(part, column).has_value());
  }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    grid.lines.emplace_back();
    for (std::size_t column = 0; column < table.columns().size(); ++column) {
      const auto digits = digits_of(part, column);
      grid.lines.back().push_back(digits ? rounded(table.number(row, column), *digits)
                                         : table.text(row, column));
    }
  }
  return grid;
}

std::string padded(const std::string& word, std::size_t width, bool right) {
  const std::string blanks(width - word.size(), ' ');
  return right ? blanks + word : word + blanks;
}

std::vector<std::size_t> widths_of(const Grid& grid) {
  std::vector<std::size_t> widths(grid.right.size());
  for (const auto& line : grid.lines) {
    for (std::size_t column = 0; column < line.size(); ++column) {
      widths[column] = std::max(widths[column], line[column].size());
    }
  }
  return widths;
}

std::string text_of(const Grid& grid) {
  const auto widths = widths_of(grid);
  std::string text;
  for (std::size_t i = 0; i < grid.lines.size(); ++i) {
    std::string line = " ";
    for (std::size_t column = 0; column < widths.size(); ++column) {
      line += " " + padded(grid.lines[i][column], widths[column], grid.right[column]) + " ";
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    if (i == 0) text += "  " + std::string(line.size() - 3, '-') + "\n";
  }
  return text;
}

std::string markdown_of(const Grid& grid) {
  std::string text;
  for (std::size_t i = 0; i < grid.lines.size(); ++i) {
    for (const auto& word : grid.lines[i]) text += "| " + word + " ";
    text += "|\n";
    if (i > 0) continue;
    for (const bool right : grid.right) text += right ? "|---:" : "|---";
    text += "|\n";
  }
  return text;
}

}  // namespace

std::string as_text(const Specification& specification, const std::vector<CsvTable>& tables) {
  std::string text = "\n" + specification.title + "\n";
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto& part = specification.parts[i];
    text +=
        "\n" + (part.title.empty() ? "" : part.title + "\n") + text_of(grid_of(part, tables[i]));
  }
  if (!specification.notes.empty()) text += "\n";
  for (const auto& note : specification.notes) text += note + "\n";
  return text;
}

std::string as_markdown(const Specification& specification, const std::vector<CsvTable>& tables) {
  std::string text = "# " + specification.title + "\n";
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto& part = specification.parts[i];
    text += "\n" + (part.title.empty() ? "" : part.title + "\n\n") +
            markdown_of(grid_of(part, tables[i]));
  }
  for (const auto& note : specification.notes) text += "\n" + note + "\n";
  return text;
}

}  // namespace shakebed::figures
