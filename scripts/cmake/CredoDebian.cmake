# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0

# Debian packages of what others build upon: cpack --config CPackConfig.cmake, in the build folder.
# Build the targets credo_evidence and credo_python first (preset evidence); nothing else is packaged.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL evidence)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Credo Authors")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # else the project's comes before each of those below

set(CPACK_DEBIAN_EVIDENCE_PACKAGE_NAME libcredo-evidence-dev)
set(CPACK_DEBIAN_EVIDENCE_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_EVIDENCE_DESCRIPTION "Belief functions in C++
Frames of Shafer's, free and hybrid models, mass functions, combination rules, discounting, measures and decisions,
as a static library with its headers and CMake package.")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/libcredo-evidence-dev RENAME copyright
  COMPONENT evidence)

if(TARGET credo_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-credo)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3-numpy, \
python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), python3 (<< ${Python3_VERSION_MAJOR}.${next_minor})")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Belief functions in Python
The module credo.evidence: frames of Shafer's, free and hybrid models, mass functions, combination rules, discounting,
measures and decisions, with numpy arrays in and out.")
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/python3-credo RENAME copyright COMPONENT python)
endif()
include(CPack)
