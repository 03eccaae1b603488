# Language level, warnings, compiler cache, linker and sanitizers: what every target shares.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1")

option(DAUMIER_CCACHE "Compile through ccache where it is installed" OFF)
set(DAUMIER_SANITIZE OFF CACHE STRING "Sanitizers of the rooms without LibTorch: OFF, ON (ASan and UBSan), thread (TSan) or fuzz (as ON, with libFuzzer; clang)")
option(DAUMIER_TRAINING_LIBRARY "Build the rooms with LibTorch, which train, eval, ablate and export need" ON)
set(DAUMIER_TRAINING ${DAUMIER_TRAINING_LIBRARY})
if(DAUMIER_SANITIZE)
  set(DAUMIER_TRAINING OFF)  # LibTorch itself is not built for the sanitizers.
endif()
option(DAUMIER_UNITY "Compile several files of a room at once: a cold build takes less time, one changed file more" OFF)
option(DAUMIER_QUICK_COMPILATION "Compile in the least time: without Eigen's checks, and without the loops that the compiler vectorises and unrolls" OFF)
set(DAUMIER_UNITY_FILES 12 CACHE STRING "Most files of a room without LibTorch that are compiled at once")
set(DAUMIER_DEBUG_INFO "" CACHE STRING "Debug information of release builds, for example -g1")

add_compile_options(-Wall -Wextra -Wno-missing-field-initializers ${DAUMIER_DEBUG_INFO})
# Rooms are linked into the program and into the training library. Without interposition position-independent code inlines
# as a program's own does.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
add_compile_options(-fno-semantic-interposition)
add_compile_definitions(DAUMIER_VERSION="${PROJECT_VERSION}")
if(DAUMIER_QUICK_COMPILATION)
  add_compile_definitions(EIGEN_NO_DEBUG)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    add_compile_options(-fno-vectorize -fno-slp-vectorize -fno-unroll-loops)
  endif()
endif()

find_program(ccache_program ccache)
if(DAUMIER_CCACHE AND ccache_program)
  # Precompiled headers only hit the cache under these rules, and other checkouts and build folders only by relative paths.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${ccache_program})
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
else()
  add_compile_options(-fpch-preprocess)
endif()

find_program(mold_program mold)
if(mold_program)
  add_link_options(-fuse-ld=mold)
endif()

if(DAUMIER_SANITIZE STREQUAL "thread")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
elseif(DAUMIER_SANITIZE STREQUAL "fuzz")
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
elseif(DAUMIER_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
