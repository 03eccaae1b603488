# `cmake --install`: the program with its weights and configs, the C library, and the rooms as C++ libraries. Programs call
#   find_package(Daumier COMPONENTS faces gltf sketch)
# and link daumier::faces and so on; the component `c` is the C library, `training` the rooms with LibTorch.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(daumier_private_folder ${CMAKE_INSTALL_LIBDIR}/daumier)
set(daumier_package ${CMAKE_INSTALL_LIBDIR}/cmake/Daumier)
set(daumier_data ${CMAKE_INSTALL_DATADIR}/daumier)

# The program finds the training library next to it, or where it is installed.
install(TARGETS daumier RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
file(RELATIVE_PATH private_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/daumier)
set_target_properties(daumier PROPERTIES INSTALL_RPATH "\$ORIGIN;\$ORIGIN/${private_from_bin}")
if(DAUMIER_TRAINING)
  install(TARGETS daumier_training LIBRARY DESTINATION ${daumier_private_folder} COMPONENT training)
endif()
install(DIRECTORY weights configs DESTINATION ${daumier_data} COMPONENT data)
install(FILES LICENSE THIRD_PARTY.md README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT data)

# The C library.
set_target_properties(daumier_library PROPERTIES EXPORT_NAME c)
install(TARGETS daumier_library EXPORT daumier_c
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
install(FILES c_api/daumier.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(EXPORT daumier_c NAMESPACE daumier:: DESTINATION ${daumier_package} COMPONENT development)
file(RELATIVE_PATH prefix_from_pkgconfig ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/daumier.pc CONTENT "prefix=\${pcfiledir}/${prefix_from_pkgconfig}
libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}

Name: daumier
Description: Faces from drawings and portraits, deformable faces, rigged heads
Version: ${PROJECT_VERSION}
Libs: -L\${libdir} -ldaumier
Cflags: -I\${includedir}
")
install(FILES ${PROJECT_BINARY_DIR}/daumier.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

# The libraries of our own, and the groups of other libraries, that a target needs.
function(daumier_needs target variable)
  get_target_property(libraries ${target} INTERFACE_LINK_LIBRARIES)
  set(needs ${${variable}} ${target})
  foreach(library ${libraries})
    if(library MATCHES "^(daumier_[a-z_]+|[a-z]+_libraries)$" AND NOT library IN_LIST needs)
      daumier_needs(${library} needs)
    endif()
  endforeach()
  set(${variable} ${needs} PARENT_SCOPE)
endfunction()

set(daumier_table "")
set(daumier_training_rooms "")
foreach(room ${daumier_rooms})
  string(REPLACE "/" "_" name ${room})
  if(NOT TARGET daumier_${name} OR room MATCHES "^(cli|cli/training|studio|fuzz|c_api)$")
    continue()
  endif()
  set(needs "")
  daumier_needs(daumier_${name} needs)
  set(groups ${needs})
  list(FILTER groups INCLUDE REGEX "_libraries$")
  list(FILTER needs INCLUDE REGEX "^daumier_")
  list(APPEND installed_targets ${needs} ${groups})
  string(APPEND daumier_table "set(daumier_groups_of_${name} ${groups})\n")
  if("torch_libraries" IN_LIST groups)
    list(APPEND daumier_training_rooms ${name})
  endif()
  file(GLOB_RECURSE nested CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${room}/*.h)
  foreach(header ${nested})
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/daumier/${folder} COMPONENT development)
  endforeach()
endforeach()
list(REMOVE_DUPLICATES installed_targets)
foreach(target ${installed_targets})
  string(REGEX REPLACE "^daumier_" "" name ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
endforeach()
target_include_directories(daumier_core INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/daumier>)
target_compile_features(daumier_core PUBLIC cxx_std_20)
install(TARGETS ${installed_targets} EXPORT daumier_rooms ARCHIVE DESTINATION ${daumier_private_folder} COMPONENT development)
install(EXPORT daumier_rooms NAMESPACE daumier:: DESTINATION ${daumier_package} COMPONENT development)

configure_package_config_file(cmake/DaumierConfig.cmake.in ${PROJECT_BINARY_DIR}/DaumierConfig.cmake INSTALL_DESTINATION ${daumier_package}
                              NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/DaumierConfigVersion.cmake VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/DaumierConfig.cmake ${PROJECT_BINARY_DIR}/DaumierConfigVersion.cmake DESTINATION ${daumier_package}
        COMPONENT development)

if(BUILD_TESTING AND DAUMIER_TRAINING)
  add_test(NAME install COMMAND ${PROJECT_SOURCE_DIR}/tests/install/run.sh ${PROJECT_BINARY_DIR})
  set_tests_properties(install PROPERTIES TIMEOUT 300 LABELS plain)
endif()
