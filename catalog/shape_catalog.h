// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catalog/shape_record.h"

namespace catalog {

using ShapeId = std::int64_t;

/// What `talus catalog list` shows of a shape.
struct ShapeSummary {
  ShapeId id = 0;
  std::string name;
  int grade = 3;      // 1 best to 3 worst, see grade_of()
  double volume = 0;  // [m3]
  std::size_t face_count = 0;
  std::map<std::string, double> descriptors;
  std::vector<std::string> failed_checks;
  struct Level {
    LevelKey key;
    int parts = 0;
    int vertices = 0, faces = 0;  // of all parts
    DecompositionError error;
  };
  std::vector<Level> levels;  // volume-true ones first; by parts asked for, cap of vertices, cap of faces
};

/// A particle that could not be used: kept with its reason, so that a batch can list it and a curator find it.
struct RejectedInput {
  std::string name;
  std::string source_file;
  std::string source_sha256;
  std::string reason;
};

/// One SQLite file of shapes. Every store is one transaction; SQLite stays out of this header.
/// Throws InputError for a file that is not a Talus catalogue, is newer than this program, or stays locked. A file of
/// an older schema is brought forward when opened read_write, after a copy was kept as FILE.schema-N; read_only reads
/// it as it is. Doubles come back bit for bit, save that a descriptor, check or error figure of -0.0 comes back as 0.0.
class ShapeCatalog {
 public:
  enum class Access { read_only, read_write };  // read_write makes the file if it is missing

  ShapeCatalog(const std::filesystem::path& path, Access access);
  ~ShapeCatalog();
  ShapeCatalog(ShapeCatalog&&) noexcept;
  ShapeCatalog& operator=(ShapeCatalog&&) noexcept;

  /// Stores or replaces the shape of that name, with the grade of its checks; replacing drops its levels of detail.
  ShapeId store_shape(const ShapeRecord& shape);
  void remove_shape(const std::string& name);  // with its levels; no write if there is none
  void store_rejected(const RejectedInput& rejected);
  void forget_rejected(const std::string& name);  // no write if there is no such row
  /// Stores or replaces the levels with the same keys, all in one transaction.
  void store_levels(ShapeId id, const std::vector<LevelOfDetail>& levels);

  std::optional<ShapeId> find(const std::string& name) const;
  ShapeRecord shape(ShapeId id) const;
  ShapeSummary summary(ShapeId id) const;
  LevelOfDetail level(ShapeId id, const LevelKey& key) const;
  std::vector<RejectedInput> rejected() const;

  /// Ids in ascending order of name. Empty selects all; for example
  ///   sphericity_wadell > 0.7 and name like 'rock%' and not (failed_checks > 0 or volume < 2e-9)
  ///
  ///   expression  = conjunction { "or" conjunction }
  ///   conjunction = negation { "and" negation }
  ///   negation    = "not" negation | "(" expression ")" | comparison
  ///   comparison  = operand ("<" | "<=" | ">" | ">=" | "=" | "==" | "!=" | "<>") operand
  ///               | operand ["not"] "like" text              (% any letters, _ one letter, case of a-z ignored)
  ///               | operand ["not"] "in" "(" literal { "," literal } ")"
  ///   operand     = word | literal
  ///   literal     = number | text                            (text in ' or ", the quote inside written twice)
  ///
  /// Words, case ignored: the texts name, source_file; the numbers grade (1 best to 3 worst), volume [m3], face_count,
  /// vertex_count, failed_checks, level_count; every descriptor that some shape has. A comparison with a descriptor
  /// that a shape lacks is neither true nor false, also under "not": the shape is selected only if the rest decides. An
  /// unknown word is an InputError that names it and the nearest known one; a text compared with a number is one too.
  std::vector<ShapeId> select(const std::string& query) const;

  int schema_version() const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits.
std::string sha256(const void* bytes, std::size_t size);
std::string sha256_of_file(const std::filesystem::path& path);  // throws InputError if it cannot be read

}  // namespace catalog
