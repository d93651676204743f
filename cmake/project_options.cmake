# SPDX-License-Identifier: Apache-2.0
# Interface targets every module links: language level, warnings, optional sanitizers. No global flags.

add_library(project_options INTERFACE)
target_include_directories(project_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_features(project_options INTERFACE cxx_std_20)
target_compile_definitions(project_options INTERFACE TALUS_VERSION="${PROJECT_VERSION}"
  $<$<STREQUAL:${TALUS_PRECISION},mixed>:TALUS_MIXED_PRECISION>)
target_compile_options(project_options INTERFACE
  # All that handles objects of vector types is compiled for the instructions of dem_engine, which says so to its users.
  # GCC 12 warns of overlapping copies in "literal" + std::string where there are none (GCC bug 105329).
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wno-restrict -Wno-psabi>
  # CMake 3.25 drops CUDA standard 20 in silence with CUDA 13, so it is given by hand.
  $<$<COMPILE_LANGUAGE:CUDA>:-std=c++20 --extended-lambda --expt-relaxed-constexpr>)
if(TALUS_WARNINGS_AS_ERRORS)
  target_compile_options(project_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
if(TALUS_SANITIZE)
  target_compile_options(project_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=address,undefined -fno-omit-frame-pointer
    # Thrust forms references to the first element of empty columns.
    -fno-sanitize=null -fno-sanitize-recover=all>)
  target_link_options(project_options INTERFACE -fsanitize=address,undefined)
endif()
