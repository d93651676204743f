# SPDX-License-Identifier: Apache-2.0
# embed_migrations(OUTPUT FILE...): a C++ source with the text of each numbered migration, in order.

function(embed_migrations output)
  set(entries "")
  set(expected 1)
  foreach(file ${ARGN})
    get_filename_component(name ${file} NAME)
    if(NOT name MATCHES "^([0-9][0-9][0-9][0-9])_[a-z0-9_]+\\.sql$")
      message(FATAL_ERROR "${file}: a migration is named NNNN_words.sql")
    endif()
    math(EXPR number "1${CMAKE_MATCH_1} - 10000")
    if(NOT number EQUAL expected)
      message(FATAL_ERROR "${file}: migrations are numbered without gaps; expected ${expected}")
    endif()
    math(EXPR expected "${expected} + 1")
    file(READ ${file} text)
    string(APPEND entries "      {\"${name}\", R\"sql(${text})sql\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  file(GENERATE OUTPUT ${output} CONTENT "// Made from catalog/migrations by embed_migrations.cmake.
#include \"catalog/sqlite/schema.h\"

namespace catalog::sqlite {

const std::vector<Migration>& migrations() {
  static const std::vector<Migration> list{
${entries}  };
  return list;
}

}  // namespace catalog::sqlite
")
endfunction()
