// SPDX-License-Identifier: Apache-2.0
#include "catalog/sqlite/query.h"

#include <algorithm>
#include <set>
#include <variant>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "catalog/sqlite/query_tokens.h"
#include "catalog/sqlite/shape_rows.h"
#include "catalog/sqlite/statement.h"

namespace catalog::sqlite {
namespace {

// Below SQLite's limits (parser stack 100, of which one nesting takes up to 6; expression depth 1000; 32766
// parameters), so that the message is ours.
constexpr int kDeepestNesting = 12;
constexpr int kMostComparisons = 400;
constexpr std::size_t kMostParameters = 10000;

/// What a query may name besides descriptors, and the SQL that yields it.
struct Column {
  const char* name;
  const char* sql;
  bool is_text;
};
constexpr Column kColumns[] = {
    {"name", "shapes.name", true},
    {"grade", "shapes.grade", false},
    {"volume", "shapes.volume", false},
    {"face_count", "(SELECT face_count FROM meshes WHERE shape_id = shapes.id)", false},
    {"vertex_count", "(SELECT vertex_count FROM meshes WHERE shape_id = shapes.id)", false},
    {"failed_checks", "(SELECT count(*) FROM checks WHERE shape_id = shapes.id AND NOT passed)", false},
    {"level_count", "(SELECT count(*) FROM levels WHERE shape_id = shapes.id)", false},
    {"source_file", "shapes.source_file", true},
};
constexpr const char* kDescriptor = "(SELECT value FROM descriptors WHERE shape_id = shapes.id AND name = ?)";

using Parameter = std::variant<double, std::string>;

/// One side of a comparison.
struct Operand {
  std::string sql;
  std::vector<Parameter> parameters;
  bool is_text = false;
  std::size_t position = 0;
};

std::string lower_case(std::string word) {
  for (char& letter : word)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return word;
}

/// Recursive descent over the grammar; what it writes holds no letter of the query, which only reaches SQLite as bound
/// parameters.
class Parser {
 public:
  Parser(const std::string& query, std::vector<std::string> descriptors)
      : query_(query), tokens_(tokens_of(query)), descriptors_(std::move(descriptors)) {}

  std::string condition() {
    if (peek().kind == Token::Kind::end) return "1";
    const std::string sql = expression();
    if (peek().kind != Token::Kind::end) fail(peek(), "expected and, or, or the end, not " + shown(peek()));
    return sql;
  }
  const std::vector<Parameter>& parameters() const { return parameters_; }

 private:
  std::string expression() {
    std::string sql = conjunction();
    while (accept_keyword("or")) sql += " OR " + conjunction();
    return sql;
  }

  std::string conjunction() {
    std::string sql = negation();
    while (accept_keyword("and")) sql += " AND " + negation();
    return sql;
  }

  std::string negation() {
    if (++depth_ > kDeepestNesting) fail(peek(), "is nested too deeply; at most " + std::to_string(kDeepestNesting));
    std::string sql;
    if (accept_keyword("not")) {
      sql += "NOT ";
      sql += negation();
    } else if (accept_symbol("(")) {
      sql += "(";
      sql += expression() + ")";
      expect_symbol(")");
    } else {
      sql = comparison();
    }
    --depth_;
    return sql;
  }

  std::string comparison() {
    if (++comparisons_ > kMostComparisons)
      fail(peek(), "is too long; at most " + std::to_string(kMostComparisons) + " comparisons");
    const Operand left = operand();
    keep(left);
    const Token& token = peek();
    const bool negated = accept_keyword("not");
    if (accept_keyword("like")) return like(left, negated);
    if (accept_keyword("in")) return membership(left, negated);
    if (negated) fail(peek(), "expected like or in after not");
    for (const char* symbol : {"<=", ">=", "==", "!=", "<>", "<", ">", "="})
      if (accept_symbol(symbol)) {
        const Operand right = operand();
        expect_same_kind(left, right);
        keep(right);
        return "(" + left.sql + " " + symbol + " " + right.sql + ")";
      }
    fail(token, "expected a comparison (< <= > >= = != like in) after '" + tokens_[at_ - 1].spelling + "', not " +
                    shown(token));
  }

  std::string like(const Operand& left, bool negated) {
    const Operand pattern = literal();
    if (!left.is_text || !pattern.is_text)
      fail(peek(), "like compares texts: name like 'rock%', with % for any letters and _ for one");
    keep(pattern);
    return "(" + left.sql + (negated ? " NOT LIKE " : " LIKE ") + pattern.sql + ")";
  }

  std::string membership(const Operand& left, bool negated) {
    expect_symbol("(");
    std::string list;
    do {
      const Operand member = literal();
      expect_same_kind(left, member);
      keep(member);
      list += (list.empty() ? "" : ", ") + member.sql;
    } while (accept_symbol(","));
    expect_symbol(")");
    return "(" + left.sql + (negated ? " NOT IN (" : " IN (") + list + "))";
  }

  Operand operand() {
    if (peek().kind != Token::Kind::word) return literal();
    const Token token = take();
    const std::string word = lower_case(token.spelling);
    for (const Column& column : kColumns)
      if (word == column.name) return {column.sql, {}, column.is_text, token.position};
    // The exact spelling wins over one that differs in case only.
    auto named = std::find(descriptors_.begin(), descriptors_.end(), token.spelling);
    if (named == descriptors_.end())
      named =
          std::find_if(descriptors_.begin(), descriptors_.end(), [&](const auto& n) { return lower_case(n) == word; });
    if (named != descriptors_.end()) return {kDescriptor, {*named}, false, token.position};
    unknown(token);
  }

  Operand literal() {
    const Token token = take();
    if (token.kind == Token::Kind::number) return {"?", {token.number}, false, token.position};
    if (token.kind == Token::Kind::text) return {"?", {token.spelling}, true, token.position};
    fail(token, "expected a name, a number or a text in quotes, not " + shown(token));
  }

  [[noreturn]] void unknown(const Token& token) {
    const std::set<std::string> keywords{"and", "or", "not", "like", "in"};
    if (keywords.contains(lower_case(token.spelling)))
      fail(token, "expected a name, a number or a text in quotes, not " + shown(token));
    std::vector<std::string> known = descriptors_;
    for (const Column& column : kColumns) known.push_back(column.name);
    fail(token,
         "unknown word '" + token.spelling + "'; " + word_hint(token.spelling, known) + " Texts stand in quotes");
  }

  void expect_same_kind(const Operand& left, const Operand& right) {
    if (left.is_text != right.is_text)
      throw InputError(query_fault(query_, right.position,
                                   "compares a text with a number; texts stand in quotes, "
                                   "numbers without"));
  }

  void keep(const Operand& operand) {
    parameters_.insert(parameters_.end(), operand.parameters.begin(), operand.parameters.end());
    if (parameters_.size() > kMostParameters)
      fail(peek(), "is too long; at most " + std::to_string(kMostParameters) + " values");
  }

  const Token& peek() const { return tokens_[at_]; }
  Token take() { return peek().kind == Token::Kind::end ? peek() : tokens_[at_++]; }
  bool accept(Token::Kind kind, const std::string& spelling) {
    const bool found = peek().kind == kind && lower_case(peek().spelling) == spelling;
    if (found) ++at_;
    return found;
  }
  bool accept_keyword(const char* word) { return accept(Token::Kind::word, word); }
  bool accept_symbol(const char* symbol) { return accept(Token::Kind::symbol, symbol); }
  void expect_symbol(const char* symbol) {
    if (!accept_symbol(symbol)) fail(peek(), std::string("expected '") + symbol + "', not " + shown(peek()));
  }

  static std::string shown(const Token& token) {
    return token.kind == Token::Kind::end ? token.spelling : "'" + token.spelling + "'";
  }
  [[noreturn]] void fail(const Token& token, const std::string& fault) const {
    throw InputError(query_fault(query_, token.position, fault));
  }

  const std::string& query_;
  std::vector<Token> tokens_;
  std::vector<std::string> descriptors_;
  std::vector<Parameter> parameters_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int comparisons_ = 0;
};

}  // namespace

std::vector<ShapeId> select_shapes(const Database& database, const std::string& query) {
  Parser parser(query, descriptor_names(database));
  const std::string condition = parser.condition();
  Statement statement(database, "SELECT id FROM shapes WHERE " + condition + " ORDER BY name");
  for (const Parameter& parameter : parser.parameters())
    std::visit([&](const auto& value) { statement.add(value); }, parameter);
  std::vector<ShapeId> ids;
  while (statement.step()) ids.push_back(statement.integer(0));
  return ids;
}

}  // namespace catalog::sqlite
