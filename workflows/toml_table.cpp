// SPDX-License-Identifier: Apache-2.0
#include "workflows/toml_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "workflows/plain_name.h"
#include "workflows/text_format.h"

namespace workflows {
namespace {

std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "text";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "\"" : ", \"") + word + "\"";
  return list;
}

std::string quantity_words(Dimension dimension) {
  const std::string units = accepted_units(dimension);
  return units.empty() ? "a number" : "a number in SI, or text ending in one of " + units;
}

bool is_within(double value, const Bounds& bounds) {
  return std::isfinite(value) && (bounds.low_is_open ? value > bounds.low : value >= bounds.low) &&
         value <= bounds.high;
}

}  // namespace

TomlTable::TomlTable(const toml::table& table, std::string file, std::string title)
    : table_(&table), file_(std::move(file)), title_(std::move(title)) {}

const toml::node* TomlTable::find(std::string_view key) {
  known_.emplace(key);
  return table_->get(key);
}

const toml::node& TomlTable::require(std::string_view key) {
  if (const toml::node* node = find(key)) return *node;
  // Missing while one close to it stands in the table: a slip of the pen, reported as such.
  for (const auto& [present, node] : *table_)
    if (!known_.contains(present.str()) && catalog::nearest_word(present.str(), {std::string(key)}))
      refuse_unknown(present, {std::string(key)});
  refuse("key '" + std::string(key) + "' is missing");
}

bool TomlTable::has(std::string_view key) { return find(key) != nullptr; }

bool TomlTable::is_text(std::string_view key) {
  const toml::node* node = find(key);
  return node && node->is_string();
}

double TomlTable::element(const toml::node& node, const std::string& place, Dimension dimension,
                          const Bounds& bounds) const {
  std::optional<double> value;
  std::string shown;
  if (const auto text = node.value_exact<std::string>()) {
    value = parse_quantity(*text, dimension);
    shown = "\"" + *text + "\"";
  } else if (node.is_number()) {
    value = node.value<double>();
    shown = formatted("%.6g", *value);
  } else {
    shown = kind_of(node);
  }
  if (!value) refuse_at(node.source(), place + " is " + shown + "; expected " + quantity_words(dimension));
  if (!is_within(*value, bounds)) refuse_at(node.source(), place + " is " + shown + "; it must be " + bounds.words);
  return *value;
}

double TomlTable::quantity(std::string_view key, Dimension dimension, const Bounds& bounds) {
  return element(require(key), std::string(key), dimension, bounds);
}

double TomlTable::quantity(std::string_view key, Dimension dimension, const Bounds& bounds, double default_value) {
  return optional_quantity(key, dimension, bounds).value_or(default_value);
}

std::optional<double> TomlTable::optional_quantity(std::string_view key, Dimension dimension, const Bounds& bounds) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return element(*node, std::string(key), dimension, bounds);
}

std::array<double, 3> TomlTable::element_vector(const toml::node& node, const std::string& place, Dimension dimension,
                                                const Bounds& bounds) const {
  const toml::array* array = node.as_array();
  if (!array || array->size() != 3) refuse_at(node.source(), place + " must be an array of three: [x, y, z]");
  std::array<double, 3> vector{};
  for (std::size_t i = 0; i < 3; ++i)
    vector[i] = element((*array)[i], place + "[" + std::to_string(i) + "]", dimension, bounds);
  return vector;
}

std::array<double, 3> TomlTable::vector(std::string_view key, Dimension dimension, const Bounds& bounds) {
  return element_vector(require(key), std::string(key), dimension, bounds);
}

std::array<double, 3> TomlTable::direction(std::string_view key) {
  std::array<double, 3> vector = this->vector(key, Dimension::ratio);
  const double length = std::hypot(vector[0], vector[1], vector[2]);
  if (length == 0) refuse(key, std::string(key) + " is [0, 0, 0]; it must point somewhere");
  for (double& component : vector) component /= length;
  return vector;
}

std::string TomlTable::text(std::string_view key) {
  const toml::node& node = require(key);
  if (const auto text = node.value_exact<std::string>()) return *text;
  refuse(key, std::string(key) + " is " + kind_of(node) + "; expected text in quotes");
}

std::string TomlTable::text(std::string_view key, std::string default_value) {
  return has(key) ? text(key) : std::move(default_value);
}

std::string TomlTable::plain_name(std::string_view key) {
  std::string name = text(key);
  if (!is_plain_name(name)) refuse(key, std::string(key) + " is " + shown_name(name) + "; " + kPlainName);
  return name;
}

std::string TomlTable::plain_name(std::string_view key, std::string default_value) {
  return has(key) ? plain_name(key) : std::move(default_value);
}

bool TomlTable::flag(std::string_view key, bool default_value) {
  const toml::node* node = find(key);
  if (!node) return default_value;
  if (const auto value = node->value_exact<bool>()) return *value;
  refuse(key, std::string(key) + " is " + kind_of(*node) + "; expected true or false");
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t least, std::int64_t most) {
  const toml::node& node = require(key);
  const auto value = node.value_exact<std::int64_t>();
  const std::string range = "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  if (!value) refuse(key, std::string(key) + " is " + kind_of(node) + "; expected " + range);
  if (*value < least || *value > most)
    refuse(key, std::string(key) + " is " + std::to_string(*value) + "; expected " + range);
  return *value;
}

int TomlTable::choice(std::string_view key, const std::vector<std::string>& choices) {
  const std::string word = text(key);
  const auto found = std::find(choices.begin(), choices.end(), word);
  if (found == choices.end()) {
    const auto nearest = catalog::nearest_word(word, choices);
    refuse(key, std::string(key) + " is \"" + word + "\"; " +
                    (nearest ? "nearest known: \"" + *nearest + "\" (of " + listed(choices) + ")"
                             : "expected one of " + listed(choices)));
  }
  return static_cast<int>(found - choices.begin());
}

std::string TomlTable::called(std::string_view key) const {
  return title_.empty() ? std::string(key) : title_ + "." + std::string(key);
}

TomlTable TomlTable::table(std::string_view key) {
  const toml::node& node = require(key);
  if (const toml::table* table = node.as_table()) return TomlTable(*table, file_, called(key));
  refuse(key, std::string(key) + " is " + kind_of(node) + "; expected a table: [" + std::string(key) + "] or {...}");
}

std::optional<TomlTable> TomlTable::optional_table(std::string_view key) {
  if (!has(key)) return std::nullopt;
  return table(key);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  std::vector<TomlTable> list;
  const toml::node* node = find(key);
  if (!node) return list;
  const toml::array* array = node->as_array();
  const auto is_table = [](const toml::node& element) { return element.is_table(); };
  if (!array || !std::all_of(array->begin(), array->end(), is_table))
    refuse(key, std::string(key) + " is " + kind_of(*node) + "; expected tables headed [[" + std::string(key) + "]]");
  for (const toml::node& element : *array)
    list.emplace_back(*element.as_table(), file_, called(key) + "[" + std::to_string(list.size()) + "]");
  return list;
}

std::vector<TomlTable> TomlTable::named_tables(std::string_view key) {
  std::vector<TomlTable> list;
  if (!has(key)) return list;
  const TomlTable parent = table(key);
  for (const auto& [name, node] : *parent.table_) {
    const std::string title = std::string(key) + " \"" + std::string(name.str()) + "\"";
    if (!is_plain_name(std::string(name.str())))
      refuse_at(name.source(),
                std::string(key) + " is named " + shown_name(std::string(name.str())) + "; " + kPlainName);
    if (!node.is_table())
      refuse_at(name.source(), title + " is " + kind_of(node) + "; expected a table headed [" + std::string(key) + "." +
                                   std::string(name.str()) + "]");
    list.emplace_back(*node.as_table(), file_, title);
    list.back().name_ = name.str();
  }
  std::stable_sort(list.begin(), list.end(), [](const TomlTable& a, const TomlTable& b) {
    return a.table_->source().begin < b.table_->source().begin;
  });
  return list;
}

const toml::array& TomlTable::array(std::string_view key) {
  const toml::node& node = require(key);
  if (const toml::array* array = node.as_array()) return *array;
  refuse(key, std::string(key) + " is " + kind_of(node) + "; expected an array [...]");
}

void TomlTable::expect_only(const std::vector<std::string>& keys) {
  known_.insert(keys.begin(), keys.end());
  finish();
}

void TomlTable::finish() const {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const auto& [key, node] : *table_)
    if (!known_.contains(key.str())) refuse_unknown(key, known);
}

void TomlTable::refuse_unknown(const toml::key& key, const std::vector<std::string>& known) const {
  const auto nearest = catalog::nearest_word(key.str(), known);
  refuse_at(key.source(),
            "unknown key '" + std::string(key.str()) + "'; " +
                (nearest ? "nearest known key: '" + *nearest + "'" : "known keys: " + catalog::quoted_list(known)));
}

void TomlTable::refuse(std::string_view key, const std::string& message) const {
  const toml::node* node = table_->get(key);
  refuse_at(node ? node->source() : table_->source(), message);
}

void TomlTable::refuse(const std::string& message) const { refuse_at(table_->source(), message); }

std::string TomlTable::place() const {
  const auto& begin = table_->source().begin;
  return begin ? file_ + ":" + std::to_string(begin.line) + ":" + std::to_string(begin.column) : file_;
}

void TomlTable::refuse_at(const toml::source_region& source, const std::string& message) const {
  std::string line = file_ + ":";
  if (source.begin) line += std::to_string(source.begin.line) + ":" + std::to_string(source.begin.column) + ":";
  throw catalog::InputError(line + " " + (title_.empty() ? "" : title_ + ": ") + message);
}

}  // namespace workflows
