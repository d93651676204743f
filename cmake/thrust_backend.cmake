# SPDX-License-Identifier: Apache-2.0
# dem_thrust: Thrust headers and the device system chosen by TALUS_BACKEND. The CPU back ends take the CUDA toolkit's
# CCCL headers if they are there, else Debian's libthrust-dev; both compile the same sources.

if(NOT BUILD_DEM)
  return()
endif()

add_library(dem_thrust INTERFACE)
if(TALUS_BACKEND STREQUAL "CUDA")
  if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
    set(CMAKE_CUDA_ARCHITECTURES 80 90)
  endif()
  enable_language(CUDA)
  find_package(CUDAToolkit REQUIRED)
  target_link_libraries(dem_thrust INTERFACE CUDA::cudart_static)
  # nvcc finds its own headers; what the host's compiler takes must be the same ones, not Debian's.
  find_path(TALUS_THRUST_INCLUDE thrust/version.h HINTS ${CUDAToolkit_INCLUDE_DIRS} PATH_SUFFIXES cccl
    NO_DEFAULT_PATH NO_CACHE REQUIRED)
  target_include_directories(dem_thrust SYSTEM INTERFACE $<$<COMPILE_LANGUAGE:CXX>:${TALUS_THRUST_INCLUDE}>)
else()
  find_path(TALUS_THRUST_INCLUDE thrust/version.h
    HINTS $ENV{CUDA_HOME}/include/cccl /usr/local/cuda/include/cccl PATHS /usr/include NO_CACHE REQUIRED)
  target_include_directories(dem_thrust SYSTEM INTERFACE ${TALUS_THRUST_INCLUDE})
  target_compile_definitions(dem_thrust INTERFACE
    THRUST_DEVICE_SYSTEM=THRUST_DEVICE_SYSTEM_${TALUS_BACKEND}
    THRUST_HOST_SYSTEM=THRUST_HOST_SYSTEM_CPP)
  if(TALUS_BACKEND STREQUAL "OMP")
    find_package(OpenMP REQUIRED COMPONENTS CXX)
    target_link_libraries(dem_thrust INTERFACE OpenMP::OpenMP_CXX)
  elseif(TALUS_BACKEND STREQUAL "TBB")
    find_package(TBB REQUIRED)
    target_link_libraries(dem_thrust INTERFACE TBB::tbb)
  endif()
endif()
target_compile_definitions(dem_thrust INTERFACE TALUS_BACKEND_${TALUS_BACKEND} TALUS_BACKEND_NAME="${TALUS_BACKEND}")
