// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace catalog::sqlite {

/// A piece of a query. Keywords (and, or, not, like, in) are words too; the parser tells them apart.
struct Token {
  enum class Kind { word, number, text, symbol, end };
  Kind kind;
  std::string spelling;  // of a text: without its quotes
  double number = 0;     // of a number
  std::size_t position;  // of its first letter in the query, from 0
};

/// Throws InputError, with the place, at a letter that starts no token or a quote that is not closed.
std::vector<Token> tokens_of(const std::string& query);

/// An InputError's text for a fault at `position`: "query '...', column N: FAULT".
std::string query_fault(const std::string& query, std::size_t position, const std::string& fault);

}  // namespace catalog::sqlite
