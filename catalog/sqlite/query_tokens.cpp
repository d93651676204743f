// SPDX-License-Identifier: Apache-2.0
#include "catalog/sqlite/query_tokens.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "catalog/input_error.h"

namespace catalog::sqlite {
namespace {

// Plain ASCII tests: the locale must not change what a query means.
bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }
bool is_word_start(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || letter == '_';
}
bool is_space(char letter) { return letter == ' ' || letter == '\t' || letter == '\n' || letter == '\r'; }

class Scanner {
 public:
  explicit Scanner(const std::string& query) : query_(query) {}

  std::vector<Token> all() {
    std::vector<Token> tokens;
    while (true) {
      while (at_ < query_.size() && is_space(query_[at_])) ++at_;
      if (at_ == query_.size()) break;
      tokens.push_back(next());
    }
    tokens.push_back({Token::Kind::end, "the end", 0, query_.size()});
    return tokens;
  }

 private:
  Token next() {
    const char first = query_[at_];
    const char second = at_ + 1 < query_.size() ? query_[at_ + 1] : '\0';
    const bool is_signed = (first == '-' || first == '+') && (is_digit(second) || second == '.');
    if (is_word_start(first)) return word();
    if (is_digit(first) || first == '.' || is_signed) return number();
    if (first == '\'' || first == '"') return text(first);
    return symbol();
  }

  Token word() {
    const std::size_t start = at_;
    while (at_ < query_.size() && (is_word_start(query_[at_]) || is_digit(query_[at_]))) ++at_;
    return {Token::Kind::word, query_.substr(start, at_ - start), 0, start};
  }

  Token number() {
    const std::size_t start = at_;
    if (query_[at_] == '+') ++at_;  // from_chars knows no plus sign
    double value = 0;
    const auto [rest, error] = std::from_chars(query_.data() + at_, query_.data() + query_.size(), value);
    at_ = static_cast<std::size_t>(rest - query_.data());
    const bool runs_on =
        at_ < query_.size() && (is_word_start(query_[at_]) || is_digit(query_[at_]) || query_[at_] == '.');
    if (error != std::errc{} || !std::isfinite(value) || runs_on)
      throw InputError(query_fault(query_, start, "expected a number such as 0.7 or 2e-9"));
    return {Token::Kind::number, query_.substr(start, at_ - start), value, start};
  }

  // A quote inside is written twice.
  Token text(char quote) {
    const std::size_t start = at_++;
    std::string letters;
    for (; at_ < query_.size(); ++at_) {
      if (query_[at_] == quote) {
        if (++at_ == query_.size() || query_[at_] != quote) return {Token::Kind::text, letters, 0, start};
      }
      letters += query_[at_];
    }
    throw InputError(query_fault(query_, start, std::string("this quote is not closed; add ") + quote));
  }

  Token symbol() {
    using namespace std::string_view_literals;
    for (const std::string_view known :
         {"<="sv, ">="sv, "=="sv, "!="sv, "<>"sv, "<"sv, ">"sv, "="sv, "("sv, ")"sv, ","sv})
      if (query_.compare(at_, known.size(), known) == 0) {
        at_ += known.size();
        return {Token::Kind::symbol, std::string(known), 0, at_ - known.size()};
      }
    throw InputError(query_fault(query_, at_,
                                 std::string("unexpected '") + query_[at_] +
                                     "'; expected a name, a number, a text in quotes, a comparison or a parenthesis"));
  }

  const std::string& query_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<Token> tokens_of(const std::string& query) { return Scanner(query).all(); }

std::string query_fault(const std::string& query, std::size_t position, const std::string& fault) {
  std::string line = query;
  for (char& letter : line)
    if (is_space(letter)) letter = ' ';  // the message stays one line
  return "query \"" + line + "\", column " + std::to_string(position + 1) + ": " + fault;
}

}  // namespace catalog::sqlite
