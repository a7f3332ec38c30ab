# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0

include(GNUInstallDirs)

# credo_add_room(NAME [USES room...] [PUBLIC lib...] [PRIVATE lib...])
# The folder NAME becomes the library credo::NAME, installed and exported as the component NAME.
function(credo_add_room name)
  cmake_parse_arguments(room "" "" "USES;PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(target credo_${name})
  if(sources)
    set(scope PUBLIC)
    add_library(${target} STATIC ${sources})
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:credo_warnings> ${room_PRIVATE})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  else()
    set(scope INTERFACE)
    add_library(${target} INTERFACE)
  endif()
  add_library(credo::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/credo>)
  list(TRANSFORM room_USES PREPEND credo::)
  target_link_libraries(${target} ${scope} ${room_USES} ${room_PUBLIC})

  install(TARGETS ${target} EXPORT credo-${name}-targets COMPONENT ${name}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/credo/${name}
    COMPONENT ${name} FILES_MATCHING PATTERN "*.hpp")
  install(EXPORT credo-${name}-targets NAMESPACE credo:: COMPONENT ${name}
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/credo)
  set_property(GLOBAL APPEND PROPERTY CREDO_ROOMS ${name})
endfunction()

# credo_install_package(): what find_package(credo COMPONENTS ...) reads.
function(credo_install_package)
  include(CMakePackageConfigHelpers)
  get_property(CREDO_ROOMS GLOBAL PROPERTY CREDO_ROOMS)
  set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/credo)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/scripts/cmake/credo-config.cmake.in
    ${PROJECT_BINARY_DIR}/credo-config.cmake INSTALL_DESTINATION ${destination})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/credo-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/credo-config.cmake ${PROJECT_BINARY_DIR}/credo-config-version.cmake
    ${PROJECT_SOURCE_DIR}/scripts/cmake/CredoOpenCV.cmake
    DESTINATION ${destination} COMPONENT evidence)
endfunction()
