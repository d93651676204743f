// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <array>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "workflows/units.h"

namespace workflows {

/// What a number may be; the words go into the message.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_is_open = false;
  const char* words = "a finite number";
};
inline constexpr Bounds kAny{};
inline constexpr Bounds kPositive{0, std::numeric_limits<double>::infinity(), true, "more than 0"};
inline constexpr Bounds kNotNegative{0, std::numeric_limits<double>::infinity(), false, "0 or more"};
inline constexpr Bounds kShare{0, 1, true, "more than 0, at most 1"};

/// A table of a TOML file, read key by key. Each key asked for becomes a known key; finish() refuses the others.
/// Everything refused is a catalog::InputError "file:line:column: title: what was expected".
class TomlTable {
 public:
  /// `title` names the table in messages: `wall "gate"`; empty for the whole file.
  TomlTable(const toml::table& table, std::string file, std::string title);

  const std::string& title() const { return title_; }
  void rename(std::string title) { title_ = std::move(title); }
  bool has(std::string_view key);

  /// Quantities are text with a unit or a bare number in SI.
  double quantity(std::string_view key, Dimension dimension, const Bounds& bounds = kAny);
  double quantity(std::string_view key, Dimension dimension, const Bounds& bounds, double default_value);
  std::optional<double> optional_quantity(std::string_view key, Dimension dimension, const Bounds& bounds = kAny);
  /// `bounds` of each component.
  std::array<double, 3> vector(std::string_view key, Dimension dimension, const Bounds& bounds = kAny);
  std::array<double, 3> direction(std::string_view key);  // made unit; refused if zero

  std::string text(std::string_view key);
  std::string text(std::string_view key, std::string default_value);
  /// Text that results are told apart by; see plain_name.h.
  std::string plain_name(std::string_view key);
  std::string plain_name(std::string_view key, std::string default_value);
  bool flag(std::string_view key, bool default_value);
  std::int64_t integer(std::string_view key, std::int64_t least, std::int64_t most);
  /// Index into `choices` of the word at `key`.
  int choice(std::string_view key, const std::vector<std::string>& choices);

  TomlTable table(std::string_view key);
  std::optional<TomlTable> optional_table(std::string_view key);
  std::vector<TomlTable> tables(std::string_view key);  // [[key]]; none if absent
  /// [key.NAME] with plain names, each titled `key "NAME"`; in file order.
  std::vector<TomlTable> named_tables(std::string_view key);
  const toml::array& array(std::string_view key);  // raw, for element() and element_vector()
  bool is_text(std::string_view key);              // false if absent

  /// One element of an array read by array(); `place` names it in messages.
  double element(const toml::node& node, const std::string& place, Dimension dimension, const Bounds& bounds) const;
  std::array<double, 3> element_vector(const toml::node& node, const std::string& place, Dimension dimension,
                                       const Bounds& bounds = kAny) const;

  /// The last part of a named table's key.
  const std::string& name() const { return name_; }

  /// Refuses any other key at once: where a slip in an optional key would show up as something else.
  void expect_only(const std::vector<std::string>& keys);
  /// Refuses keys that nobody asked for, naming the nearest known one.
  void finish() const;

  [[noreturn]] void refuse(std::string_view key, const std::string& message) const;
  [[noreturn]] void refuse(const std::string& message) const;
  /// "scene.toml:12:1" of this table.
  std::string place() const;

 private:
  const toml::node* find(std::string_view key);
  const toml::node& require(std::string_view key);
  [[noreturn]] void refuse_at(const toml::source_region& source, const std::string& message) const;
  [[noreturn]] void refuse_unknown(const toml::key& key, const std::vector<std::string>& known) const;
  std::string called(std::string_view key) const;

  const toml::table* table_;
  std::string file_;
  std::string title_;
  std::string name_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace workflows
