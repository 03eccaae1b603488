# daumier_alone(NAME SOURCES files... HEADERS files... PACKAGES packages... LIBRARIES targets...)
# A library of some files, for programs that need nothing else of this project: `cmake --install build/release --component NAME`
# builds and installs it. Programs call find_package(daumier_NAME) and link daumier::NAME. Headers are installed with their paths
# from the root, under include/daumier, which the package puts on the search path: #include <daumier/raster/camera.h>.
# Files are globs from the root.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

function(daumier_alone name)
  cmake_parse_arguments(alone "" "" "SOURCES;HEADERS;PACKAGES;LIBRARIES" ${ARGN})
  set(target daumier_${name}_alone)
  set(component COMPONENT ${name} EXCLUDE_FROM_ALL)
  set(package ${CMAKE_INSTALL_LIBDIR}/cmake/daumier_${name})
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${alone_SOURCES})
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${sources})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE "SHELL:-iquote ${PROJECT_SOURCE_DIR}")
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/daumier>)
  target_link_libraries(${target} PUBLIC ${alone_LIBRARIES})

  # Built on demand: the rule of the component builds it before its files are copied.
  install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" --build \"${PROJECT_BINARY_DIR}\" --target ${target}
                                COMMAND_ERROR_IS_FATAL ANY)" ${component})
  install(TARGETS ${target} EXPORT daumier_${name}_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} ${component})
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${alone_HEADERS})
  foreach(header ${headers})
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/daumier/${folder} ${component})
  endforeach()
  install(EXPORT daumier_${name}_targets NAMESPACE daumier:: DESTINATION ${package} ${component})
  list(TRANSFORM alone_PACKAGES REPLACE "(.+)" "find_dependency(\\1)\n" OUTPUT_VARIABLE find_packages)
  list(JOIN find_packages "" find_packages)
  set(config ${PROJECT_BINARY_DIR}/daumier_${name}-config)
  file(CONFIGURE OUTPUT ${config}.cmake CONTENT "include(CMakeFindDependencyMacro)
${find_packages}include(\${CMAKE_CURRENT_LIST_DIR}/daumier_${name}_targets.cmake)
" @ONLY)
  write_basic_package_version_file(${config}-version.cmake VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
  install(FILES ${config}.cmake ${config}-version.cmake DESTINATION ${package} ${component})
endfunction()

set(parallel_files core/parallel core/thread_pool core/num_cores)
list(TRANSFORM parallel_files APPEND .cpp OUTPUT_VARIABLE parallel_sources)
list(TRANSFORM parallel_files APPEND .h OUTPUT_VARIABLE parallel_headers)

# The differentiable renderer.
daumier_alone(raster SOURCES raster/*.cpp ${parallel_sources} HEADERS raster/*.h core/error.h ${parallel_headers}
              PACKAGES fmt Threads LIBRARIES fmt::fmt Threads::Threads)

# Exaggeration of faces by the curvature of their surface.
set(exaggeration_files core/files core/json core/options core/random faces/annotation faces/exaggeration faces/face_model faces/gradient_scaling
    geometry/alignment geometry/curvature geometry/flips geometry/normals geometry/operators geometry/poisson geometry/topology)
list(TRANSFORM exaggeration_files APPEND .cpp OUTPUT_VARIABLE exaggeration_sources)
list(TRANSFORM exaggeration_files APPEND .h OUTPUT_VARIABLE exaggeration_headers)
daumier_alone(exaggeration SOURCES ${exaggeration_sources}
              HEADERS ${exaggeration_headers} core/error.h core/options_impl.h geometry/coordinates.h geometry/mesh.h
              PACKAGES fmt Eigen3 nlohmann_json "OpenSSL COMPONENTS Crypto"
              LIBRARIES fmt::fmt Eigen3::Eigen nlohmann_json::nlohmann_json OpenSSL::Crypto)
