# SPDX-License-Identifier: Apache-2.0
# With TALUS_STATIC, programs need libc and the loader alone (and, of CUDA, the driver): they run on another machine.

if(TALUS_SHARED_ENGINE)
  set(CMAKE_BUILD_RPATH "\$ORIGIN/../lib")
endif()
if(NOT TALUS_STATIC)
  return()
endif()
set(CMAKE_FIND_LIBRARY_SUFFIXES .a .so)
target_link_options(project_options INTERFACE -static-libstdc++ -static-libgcc)
