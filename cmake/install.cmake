# What `cmake --install` puts where. The package can be moved as a whole.
include(CMakePackageConfigHelpers)
set(rill_package ${CMAKE_INSTALL_LIBDIR}/cmake/rill)
set(rill_data ${CMAKE_INSTALL_DATADIR}/rill)

set(rill_libraries rill rill_shared)
if(RILL_BUILD_SCENE)
  list(APPEND rill_libraries rill_scene rill_scene_shared)
endif()
if(RILL_BUILD_OFFLINE)
  list(APPEND rill_libraries rill_offline)
endif()
install(TARGETS ${rill_libraries} EXPORT rill INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT rill NAMESPACE rill:: FILE rillTargets.cmake DESTINATION ${rill_package})
install(DIRECTORY engine/include/rill DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

configure_package_config_file(cmake/rillConfig.cmake.in ${PROJECT_BINARY_DIR}/rillConfig.cmake INSTALL_DESTINATION ${rill_package} PATH_VARS rill_data)
# Before 1.0 each minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rillConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rillConfig.cmake ${PROJECT_BINARY_DIR}/rillConfigVersion.cmake cmake/vulkan_headers.cmake DESTINATION ${rill_package})

# pkg-config finds the prefix from where the file lies.
file(RELATIVE_PATH rill_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" rill_prefix ${rill_prefix})
set(module rill)
set(description "${PROJECT_DESCRIPTION}")
set(requires "")
configure_file(cmake/module.pc.in ${PROJECT_BINARY_DIR}/rill.pc @ONLY)
set(module rill_scene)
set(description "Scene files for Rill")
set(requires "rill = ${PROJECT_VERSION}")
configure_file(cmake/module.pc.in ${PROJECT_BINARY_DIR}/rill_scene.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/rill.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(RILL_BUILD_SCENE)
  install(FILES ${PROJECT_BINARY_DIR}/rill_scene.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()

install(DIRECTORY assets/scenes DESTINATION ${rill_data})
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
