# The renderer as a library of its own, without the rest of the project: `cmake --install build/release --component raster`.
# It needs fmt and threads alone. Of core/ it contains the pool of threads; headers are installed with their paths from the
# root, under include/daumier, which the package puts on the search path: #include <daumier/raster/camera.h>.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

file(GLOB raster_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/raster/*.cpp)
file(GLOB raster_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/raster/*.h)
add_library(daumier_raster_alone STATIC EXCLUDE_FROM_ALL ${raster_sources} ${PROJECT_SOURCE_DIR}/core/parallel.cpp
            ${PROJECT_SOURCE_DIR}/core/thread_pool.cpp ${PROJECT_SOURCE_DIR}/core/num_cores.cpp)
set_target_properties(daumier_raster_alone PROPERTIES EXPORT_NAME raster OUTPUT_NAME daumier_raster_alone)
target_compile_features(daumier_raster_alone PUBLIC cxx_std_20)
target_compile_options(daumier_raster_alone PRIVATE "SHELL:-iquote ${PROJECT_SOURCE_DIR}")
target_include_directories(daumier_raster_alone INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/daumier>)
target_link_libraries(daumier_raster_alone PUBLIC fmt::fmt Threads::Threads)

# Built on demand: the rule of the component builds it before its files are copied.
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" --build \"${PROJECT_BINARY_DIR}\" --target daumier_raster_alone
                              COMMAND_ERROR_IS_FATAL ANY)" COMPONENT raster EXCLUDE_FROM_ALL)
install(TARGETS daumier_raster_alone EXPORT daumier_raster_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT raster EXCLUDE_FROM_ALL)
install(FILES ${raster_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/daumier/raster COMPONENT raster EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_SOURCE_DIR}/core/error.h ${PROJECT_SOURCE_DIR}/core/parallel.h
        ${PROJECT_SOURCE_DIR}/core/thread_pool.h ${PROJECT_SOURCE_DIR}/core/num_cores.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/daumier/core COMPONENT raster EXCLUDE_FROM_ALL)
install(EXPORT daumier_raster_targets NAMESPACE daumier:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/daumier_raster
        COMPONENT raster EXCLUDE_FROM_ALL)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/daumier_raster-config.cmake @ONLY CONTENT
"include(CMakeFindDependencyMacro)
find_dependency(fmt)
find_dependency(Threads)
include(\${CMAKE_CURRENT_LIST_DIR}/daumier_raster_targets.cmake)
")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/daumier_raster-config-version.cmake VERSION ${PROJECT_VERSION}
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/daumier_raster-config.cmake ${PROJECT_BINARY_DIR}/daumier_raster-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/daumier_raster COMPONENT raster EXCLUDE_FROM_ALL)
