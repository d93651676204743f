# SPDX-License-Identifier: Apache-2.0
# Target gpu_check_folder: talus-gpu-check/ in the build folder, which runs on a machine without anything of this one.
set(TALUS_REFERENCE ${CMAKE_BINARY_DIR}/reference CACHE PATH
  "What `agreement --write` wrote in a build for the CPU, before the target gpu_check_folder is built")
set(check_folder ${CMAKE_BINARY_DIR}/talus-gpu-check)

# Left out: dem_exact_test compares functions of the host with exact arithmetic; test_bench tests pages and tables.
get_property(engine_tests GLOBAL PROPERTY TALUS_ENGINE_TESTS)
list(REMOVE_DUPLICATES engine_tests)
list(FILTER engine_tests EXCLUDE REGEX "^(dem_exact_test|test_bench) ")
list(FILTER engine_tests INCLUDE REGEX " (unit|property|validation|backend)$")
list(TRANSFORM engine_tests REPLACE " .*" "" OUTPUT_VARIABLE test_programs)
list(JOIN engine_tests "\n" lines)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/gpu_check_tests.txt CONTENT "${lines}\n")

set(programs gpu_check agreement time_scene)
if(TARGET talus-simulate)
  list(APPEND programs talus-simulate)
endif()
list(TRANSFORM test_programs REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE test_files)
list(TRANSFORM programs REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE program_files)
list(TRANSFORM test_programs PREPEND ${check_folder}/tests/ OUTPUT_VARIABLE copied_files)
list(TRANSFORM programs PREPEND ${check_folder}/bin/ OUTPUT_VARIABLE copied_programs)
list(APPEND copied_files ${copied_programs})
if(TALUS_SHARED_ENGINE)
  set(copy_library COMMAND ${CMAKE_COMMAND} -E copy $<TARGET_FILE:dem_engine> ${check_folder}/lib)
endif()
add_custom_target(gpu_check_folder
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${check_folder}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${check_folder}/tests ${check_folder}/bin ${check_folder}/lib
  COMMAND ${CMAKE_COMMAND} -E copy ${test_files} ${check_folder}/tests
  COMMAND ${CMAKE_COMMAND} -E copy ${program_files} ${check_folder}/bin
  ${copy_library}
  COMMAND strip ${copied_files}
  COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_BINARY_DIR}/gpu_check_tests.txt ${check_folder}/tests.txt
  COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_CURRENT_LIST_DIR}/benches.txt ${CMAKE_CURRENT_LIST_DIR}/run.sh ${check_folder}
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${TALUS_REFERENCE} ${check_folder}/reference
  DEPENDS ${programs} ${test_programs}
  COMMENT "Writing ${check_folder}"
  VERBATIM)
