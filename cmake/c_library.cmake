# The C library: the room c_api with all that it needs, of which only the functions of daumier.h can be seen.
add_library(daumier_library SHARED $<TARGET_OBJECTS:daumier_c_api>)
get_target_property(c_api_libraries daumier_c_api LINK_LIBRARIES)
target_link_libraries(daumier_library PRIVATE ${c_api_libraries})
target_link_options(daumier_library PRIVATE "LINKER:--version-script=${PROJECT_SOURCE_DIR}/c_api/symbols.map" LINKER:--no-undefined)
set_target_properties(daumier_library PROPERTIES OUTPUT_NAME daumier VERSION ${PROJECT_VERSION} SOVERSION 0 LINKER_LANGUAGE CXX
                      LINK_DEPENDS ${PROJECT_SOURCE_DIR}/c_api/symbols.map LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
target_include_directories(daumier_library INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/c_api>
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
