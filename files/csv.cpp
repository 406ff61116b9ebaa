#include "files/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "files/atomic_file.hpp"
#include "files/yaml.hpp"

namespace shakebed::files {

namespace {

/// Quotes a cell as RFC 4180 does when its text would not survive otherwise. A leading # is
/// quoted because it would read as a provenance line, outer blanks because readers may trim them.
std::string quoted(const std::string& cell) {
  const bool plain =
      cell.find_first_of(",\"\r\n") == std::string::npos &&
      (cell.empty() || (cell.front() != '#' && cell.front() != ' ' && cell.back() != ' '));
  if (plain) return cell;
  std::string text = "\"";
  for (const char c : cell) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    line += quoted(cells[i]);
  }
  // An empty line would read as the end of the rows.
  if (line.empty()) line = "\"\"";
  return line + '\n';
}

CsvColumn column_from_header(const std::string& cell) {
  const std::size_t bracket = cell.rfind(" [");
  if (bracket == std::string::npos || cell.back() != ']') return {cell, ""};
  return {cell.substr(0, bracket), cell.substr(bracket + 2, cell.size() - bracket - 3)};
}

/// Splits the text of a table into records; quoted cells may hold commas, quotes and newlines.
class Reader {
 public:
  Reader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  bool at_end() const { return position_ >= text_.size(); }
  std::size_t line() const { return line_; }
  std::string place() const { return name_ + ":" + std::to_string(line_); }
  bool at_provenance() const { return !at_end() && text_[position_] == '#'; }

  std::string rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    std::string line(text_.substr(position_, end - position_));
    if (!line.empty() && line.back() == '\r') line.pop_back();
    position_ = end + 1;
    ++line_;
    return line;
  }

  std::vector<std::string> record() {
    std::vector<std::string> cells;
    do {
      cells.push_back(cell());
    } while (take(','));
    take('\r');
    if (!take('\n') && !at_end()) {
      throw bad_input(place(), "expected a comma or the end of the line after a quoted cell");
    }
    ++line_;
    return cells;
  }

 private:
  bool take(char c) {
    if (at_end() || text_[position_] != c) return false;
    ++position_;
    return true;
  }

  std::string cell() {
    if (take('"')) return quoted_cell();
    const std::size_t end = std::min(text_.find_first_of(",\r\n", position_), text_.size());
    std::string cell(text_.substr(position_, end - position_));
    position_ = end;
    return cell;
  }

  std::string quoted_cell() {
    const std::string opened_at = place();
    std::string cell;
    while (!at_end()) {
      const char c = text_[position_++];
      if (c == '"' && !take('"')) return cell;
      if (c == '\n') ++line_;
      cell += c;
    }
    throw bad_input(opened_at, "a quoted cell is never closed; the file may be cut short");
  }

  std::string_view text_;
  std::string name_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
};

}  // namespace

bool CsvTable::has_column(std::string_view wanted) const {
  return std::any_of(columns_.begin(), columns_.end(),
                     [&](const CsvColumn& column) { return column.name == wanted; });
}

std::size_t CsvTable::column(std::string_view wanted) const {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].name == wanted) return i;
    known.push_back(columns_[i].name);
  }
  std::string what = "has no column `" + std::string(wanted) + "`";
  if (const auto near = nearest_word(wanted, known)) {
    what += "; the nearest is `" + *near + "`";
  } else {
    what += "; it has";
    for (const auto& one : known) what += " " + one;
  }
  throw bad_input(name, what);
}

void CsvTable::add_row(std::vector<std::string> cells) {
  if (cells.size() != columns_.size()) {
    throw bad_input(name + ": row " + std::to_string(rows() + 1),
                    "expected " + std::to_string(columns_.size()) + " cells, one a column, got " +
                        std::to_string(cells.size()));
  }
  cells_.push_back(std::move(cells));
}

const std::string& CsvTable::text(std::size_t row, std::size_t column) const {
  return cells_.at(row).at(column);
}

std::string CsvTable::place(std::size_t row) const {
  if (row < lines_.size()) return name + ":" + std::to_string(lines_[row]);
  return name + ": row " + std::to_string(row + 1);
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const std::string& cell = text(row, column);
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (const auto value = number_from_text(cell)) return *value;
  throw bad_input(place(row),
                  "column `" + columns_[column].name + "`: expected a number, got `" + cell + "`");
}

std::vector<double> CsvTable::numbers(std::string_view column_name) const {
  const std::size_t index = column(column_name);
  std::vector<double> values(rows());
  for (std::size_t row = 0; row < rows(); ++row) values[row] = number(row, index);
  return values;
}

std::string CsvTable::to_text() const {
  std::string text;
  for (const auto& entry : provenance) {
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
      end = entry.find('\n', begin);
      text += "# " + entry.substr(begin, end - begin) + '\n';
    }
  }
  std::vector<std::string> header;
  for (const auto& column : columns_) header.push_back(column.name + " [" + column.unit + "]");
  text += joined(header);
  for (const auto& row : cells_) text += joined(row);
  return text;
}

void CsvTable::write(const std::filesystem::path& file) const { write_text(file, to_text()); }

CsvTable CsvTable::read(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  Reader reader(text, file.string());
  std::vector<std::string> provenance;
  while (reader.at_provenance()) {
    const std::string line = reader.rest_of_line();
    provenance.push_back(line.substr(line.starts_with("# ") ? 2 : 1));
  }
  if (reader.at_end()) throw bad_input(file.string(), "has no header line `name [unit],...`");

  const std::string header_place = reader.place();
  std::vector<CsvColumn> columns;
  std::set<std::string> seen;
  for (const auto& cell : reader.record()) {
    columns.push_back(column_from_header(cell));
    if (!seen.insert(columns.back().name).second) {
      throw bad_input(header_place, "column `" + columns.back().name + "` stands there twice");
    }
  }
  CsvTable table(std::move(columns));
  table.name = file.string();
  table.provenance = std::move(provenance);
  while (!reader.at_end()) {
    const std::size_t line = reader.line();
    const std::string place = reader.place();
    std::vector<std::string> cells = reader.record();
    if (cells.size() != table.columns_.size()) {
      throw bad_input(place, "expected " + std::to_string(table.columns_.size()) +
                                 " cells, one a column, got " + std::to_string(cells.size()));
    }
    table.add_row(std::move(cells));
    table.lines_.push_back(line);
  }
  return table;
}

std::string rounded_text(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string number_text(double value) {
  if (std::isnan(value)) return "";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::optional<double> number_from_text(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> share_from_percent_text(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  if (const auto last = text.find_last_not_of(' '); last != std::string_view::npos) {
    text = text.substr(0, last + 1);
  }
  const auto percents = number_from_text(text);
  return percents ? std::optional(*percents / 100) : std::nullopt;
}

}  // namespace shakebed::files
