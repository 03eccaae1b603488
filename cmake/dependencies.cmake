# Every library that we use, grouped by the rooms that need it.
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(Eigen3 REQUIRED)
find_library(DNNL_LIBRARY dnnl REQUIRED)
find_path(DNNL_INCLUDE_DIR dnnl.h REQUIRED)
add_library(network_libraries INTERFACE)
target_link_libraries(network_libraries INTERFACE ${DNNL_LIBRARY})
target_include_directories(network_libraries SYSTEM INTERFACE ${DNNL_INCLUDE_DIR})

# Ceres drags ATLAS into an executable, and a program's libraries are searched in the order of linking: the first
# libblas serves LibTorch. The system's own choice (an alternative, OpenBLAS where it is installed) comes first here.
find_library(SYSTEM_BLAS NAMES libblas.so.3 REQUIRED)
find_library(SYSTEM_LAPACK NAMES liblapack.so.3 REQUIRED)
add_library(blas_libraries INTERFACE)
target_link_libraries(blas_libraries INTERFACE -Wl,--push-state,--no-as-needed ${SYSTEM_BLAS} ${SYSTEM_LAPACK} -Wl,--pop-state)

add_library(base_libraries INTERFACE)
target_link_libraries(base_libraries INTERFACE fmt::fmt spdlog::spdlog nlohmann_json::nlohmann_json
                      tomlplusplus::tomlplusplus OpenSSL::Crypto Threads::Threads)

find_path(NANOFLANN_INCLUDE_DIR nanoflann.hpp REQUIRED)
find_path(SPECTRA_INCLUDE_DIR Spectra/SymEigsSolver.h REQUIRED)
add_library(mesh_libraries INTERFACE)
target_link_libraries(mesh_libraries INTERFACE Eigen3::Eigen)
target_include_directories(mesh_libraries SYSTEM INTERFACE ${NANOFLANN_INCLUDE_DIR} ${SPECTRA_INCLUDE_DIR})

find_library(PNG_LIBRARY png REQUIRED)
find_library(JPEG_LIBRARY jpeg REQUIRED)
add_library(image_libraries INTERFACE)
target_link_libraries(image_libraries INTERFACE ${PNG_LIBRARY} ${JPEG_LIBRARY})
if(DAUMIER_TRAINING)
  find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs dnn)
  target_link_libraries(image_libraries INTERFACE opencv_core opencv_imgproc)
else()  # OpenCV's own configuration demands the packages of all its modules.
  find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
  target_include_directories(image_libraries SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
  foreach(module core imgproc)
    find_library(OPENCV_${module}_LIBRARY opencv_${module} REQUIRED)
    target_link_libraries(image_libraries INTERFACE ${OPENCV_${module}_LIBRARY})
  endforeach()
endif()

find_package(pugixml REQUIRED)
find_package(ZLIB REQUIRED)
add_library(markup_libraries INTERFACE)
target_link_libraries(markup_libraries INTERFACE pugixml::pugixml ZLIB::ZLIB)

find_package(meshoptimizer REQUIRED)
add_library(compression_libraries INTERFACE)
target_link_libraries(compression_libraries INTERFACE meshoptimizer::meshoptimizer)

# Loaded when they are needed first (core/late_library.h), by the names under which the dynamic loader finds them. With both
# come 37 other libraries.
find_package(LibArchive REQUIRED)
find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)  # CMake's own module needs the language C.
find_library(HDF5_LIBRARY NAMES hdf5_serial hdf5 REQUIRED)
add_library(archive_libraries INTERFACE)
target_link_libraries(archive_libraries INTERFACE ZLIB::ZLIB)
target_include_directories(archive_libraries SYSTEM INTERFACE ${LibArchive_INCLUDE_DIRS} ${HDF5_INCLUDE_DIR})
foreach(library ${LibArchive_LIBRARIES}:LIBARCHIVE ${HDF5_LIBRARY}:HDF5)
  string(REPLACE ":" ";" library ${library})
  list(GET library 0 file)
  list(GET library 1 name)
  get_filename_component(file ${file} REALPATH)
  string(REGEX REPLACE "^.*/([^/]*\\.so\\.[0-9]+)[^/]*$" "\\1" file ${file})
  target_compile_definitions(archive_libraries INTERFACE DAUMIER_${name}="${file}")
endforeach()
# What tests write such files with.
add_library(archive_writers INTERFACE)
target_link_libraries(archive_writers INTERFACE LibArchive::LibArchive ${HDF5_LIBRARY})

find_package(Ceres REQUIRED)
find_path(LIBLINEAR_INCLUDE_DIR linear.h PATH_SUFFIXES liblinear REQUIRED)
find_library(LIBLINEAR_LIBRARY linear REQUIRED)
add_library(solver_libraries INTERFACE)
target_link_libraries(solver_libraries INTERFACE blas_libraries Ceres::ceres ${LIBLINEAR_LIBRARY})
target_include_directories(solver_libraries SYSTEM INTERFACE ${LIBLINEAR_INCLUDE_DIR})

if(DAUMIER_TRAINING)
  find_package(Torch REQUIRED)
  find_package(ONNX REQUIRED)
  if(NOT TARGET ONNX::onnx)  # Debian 12 exports the targets without a namespace.
    add_library(ONNX::onnx ALIAS onnx)
    add_library(ONNX::onnx_proto ALIAS onnx_proto)
  endif()

  add_library(torch_libraries INTERFACE)
  target_link_libraries(torch_libraries INTERFACE blas_libraries ${TORCH_LIBRARIES})
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
    # at::parallel_for in our own files is serial unless they are compiled with OpenMP, in the run-time that LibTorch
    # uses.
    find_package(OpenMP REQUIRED)
    target_link_libraries(torch_libraries INTERFACE OpenMP::OpenMP_CXX)
  endif()

  add_library(onnx_libraries INTERFACE)
  target_link_libraries(onnx_libraries INTERFACE ONNX::onnx ONNX::onnx_proto opencv_dnn opencv_core)
  target_compile_definitions(onnx_libraries INTERFACE ONNX_NAMESPACE=onnx ONNX_ML=1)
  # Debian 13 has ONNX Runtime; elsewhere exported models are run by npm's package in a child process.
  find_path(ONNXRUNTIME_INCLUDE_DIR onnxruntime_cxx_api.h PATH_SUFFIXES onnxruntime)
  find_library(ONNXRUNTIME_LIBRARY onnxruntime)
  if(ONNXRUNTIME_INCLUDE_DIR AND ONNXRUNTIME_LIBRARY)
    target_include_directories(onnx_libraries SYSTEM INTERFACE ${ONNXRUNTIME_INCLUDE_DIR})
    target_link_libraries(onnx_libraries INTERFACE ${ONNXRUNTIME_LIBRARY})
    target_compile_definitions(onnx_libraries INTERFACE DAUMIER_HAS_ONNXRUNTIME)
  endif()
endif()

# A library of its own in Debian: what the package compiled in has to be said again.
find_path(HTTPLIB_INCLUDE_DIR httplib.h REQUIRED)
find_library(HTTPLIB_LIBRARY cpp-httplib REQUIRED)
add_library(server_libraries INTERFACE)
target_link_libraries(server_libraries INTERFACE ${HTTPLIB_LIBRARY})
target_include_directories(server_libraries SYSTEM INTERFACE ${HTTPLIB_INCLUDE_DIR})
target_compile_definitions(server_libraries INTERFACE CPPHTTPLIB_OPENSSL_SUPPORT CPPHTTPLIB_ZLIB_SUPPORT CPPHTTPLIB_BROTLI_SUPPORT)

find_package(CLI11 REQUIRED)
add_library(cli_libraries INTERFACE)
target_link_libraries(cli_libraries INTERFACE CLI11::CLI11)

if(BUILD_TESTING)
  find_package(GTest REQUIRED)
endif()
if(DAUMIER_TRAINING)
  find_package(benchmark)
endif()
