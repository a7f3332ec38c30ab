# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0

# The targets opencv_core, opencv_imgproc and opencv_imgcodecs. Debian ships OpenCVConfig.cmake only in the large
# libopencv-dev; the three small packages that Credo needs have the headers and libraries alone.
find_package(OpenCV CONFIG QUIET COMPONENTS core imgproc imgcodecs)
if(NOT OpenCV_FOUND)
  find_path(CREDO_OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
  foreach(module core imgproc imgcodecs)
    find_library(CREDO_OPENCV_${module}_LIBRARY opencv_${module})
    if(NOT CREDO_OPENCV_INCLUDE_DIR OR NOT CREDO_OPENCV_${module}_LIBRARY)
      message(FATAL_ERROR "OpenCV's ${module} module was not found: install libopencv-${module}-dev")
    endif()
    if(NOT TARGET opencv_${module})
      add_library(opencv_${module} SHARED IMPORTED GLOBAL)
      set_target_properties(opencv_${module} PROPERTIES
        IMPORTED_LOCATION ${CREDO_OPENCV_${module}_LIBRARY}
        INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${CREDO_OPENCV_INCLUDE_DIR}
        INTERFACE_INCLUDE_DIRECTORIES ${CREDO_OPENCV_INCLUDE_DIR})
    endif()
  endforeach()
endif()
