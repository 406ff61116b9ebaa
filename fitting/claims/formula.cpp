#include "fitting/claims/formula.hpp"

#include <array>
#include <cctype>
#include <optional>

#include "files/csv.hpp"
#include "files/error.hpp"

namespace shakebed::fitting::claims {
namespace {

using Kind = Formula::Kind;

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// A recursive descent over the text, one function a rule of the grammar.
class Reader {
 public:
  Reader(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  Formula whole() {
    Formula formula = sum();
    skip_spaces();
    if (at_ < text_.size()) expected("the end or an operator");
    return formula;
  }

 private:
  Formula sum() {
    Formula left = product();
    while (true) {
      if (take('+')) {
        left = binary(Kind::sum, std::move(left), product());
      } else if (take('-')) {
        left = binary(Kind::difference, std::move(left), product());
      } else {
        return left;
      }
    }
  }

  Formula product() {
    Formula left = factor();
    while (true) {
      if (take('*')) {
        left = binary(Kind::product, std::move(left), factor());
      } else if (take('/')) {
        left = binary(Kind::quotient, std::move(left), factor());
      } else {
        return left;
      }
    }
  }

  Formula factor() {
    if (take('-')) {
      Formula negative{Kind::negative};
      negative.parts.push_back(factor());
      return negative;
    }
    Formula formula = primary();
    while (take('[')) {
      Formula rows{Kind::rows};
      rows.parts.push_back(std::move(formula));
      do {
        rows.conditions.push_back(condition());
      } while (take(','));
      need(']');
      formula = std::move(rows);
    }
    return formula;
  }

  Formula primary() {
    skip_spaces();
    if (take('(')) {
      Formula inside = sum();
      need(')');
      return inside;
    }
    if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) return number();
    Formula named{Kind::column};
    named.word = name();
    if (!take('(')) return named;
    named.kind = Kind::call;
    if (named.word == "each") {
      named.kind = Kind::each;
      named.word = name();
      need(':');
      named.parts.push_back(sum());
    } else {
      do {
        named.parts.push_back(sum());
      } while (take(','));
    }
    need(')');
    return named;
  }

  Formula number() {
    const std::size_t first = at_;
    while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) ++at_;
    const bool exponent = at_ + 1 < text_.size() && text_[at_] == 'e' &&
                          (is_digit(text_[at_ + 1]) || text_[at_ + 1] == '-');
    if (exponent) {
      at_ += 2;
      while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
    }
    const auto value = files::number_from_text(text_.substr(first, at_ - first));
    if (!value) expected("a number");
    return {Kind::number, *value};
  }

  std::string name() {
    skip_spaces();
    const std::size_t first = at_;
    if (at_ >= text_.size() || !is_letter(text_[at_])) expected("a number, a column or a function");
    while (at_ < text_.size() &&
           (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '.')) {
      ++at_;
    }
    return std::string(text_.substr(first, at_ - first));
  }

  Condition condition() {
    Condition condition;
    condition.column = name();
    skip_spaces();
    for (const char* sign : {"!=", "<=", ">=", "=", "<", ">"}) {
      if (!text_.substr(at_).starts_with(sign)) continue;
      condition.comparison = sign;
      break;
    }
    if (condition.comparison.empty()) expected("one of = != < <= > >=");
    at_ += condition.comparison.size();
    skip_spaces();
    const std::size_t first = at_;
    while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != ']') ++at_;
    std::size_t last = at_;
    while (last > first && is_space(text_[last - 1])) --last;
    if (last == first) expected("a word or a number");
    condition.value = std::string(text_.substr(first, last - first));
    return condition;
  }

  static Formula binary(Kind kind, Formula left, Formula right) {
    Formula both{kind};
    both.parts.push_back(std::move(left));
    both.parts.push_back(std::move(right));
    return both;
  }

  void skip_spaces() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }
  bool take(char sign) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != sign) return false;
    ++at_;
    return true;
  }
  void need(char sign) {
    if (!take(sign)) expected(std::string("'") + sign + "'");
  }
  [[noreturn]] void expected(const std::string& what) const {
    const std::string got =
        at_ < text_.size() ? "'" + std::string(text_.substr(at_, 12)) + "'" : "the end";
    throw files::bad_input(where_, "formula: expected " + what + " after '" +
                                       std::string(text_.substr(0, at_)) + "', got " + got);
  }

  std::string_view text_;
  const std::string& where_;
  std::size_t at_ = 0;
};

}  // namespace

Formula read_formula(std::string_view text, const std::string& where) {
  return Reader(text, where).whole();
}

}  // namespace shakebed::fitting::claims
