# Debian ships the CMake configuration of OpenCV only with the whole of it (libopencv-dev); core
# and imgproc alone are found by hand.
find_path(OPENCV_INCLUDE_DIR opencv2/imgproc.hpp PATH_SUFFIXES opencv4 REQUIRED)
find_path(OPENCV_MODULES_DIR opencv2/opencv_modules.hpp
          HINTS "/usr/include/${CMAKE_LIBRARY_ARCHITECTURE}" PATH_SUFFIXES opencv4 REQUIRED)
find_library(OPENCV_CORE_LIBRARY opencv_core REQUIRED)
find_library(OPENCV_IMGPROC_LIBRARY opencv_imgproc REQUIRED)
add_library(verdigris_opencv INTERFACE)
target_include_directories(verdigris_opencv SYSTEM INTERFACE
  "${OPENCV_INCLUDE_DIR}" "${OPENCV_MODULES_DIR}")
target_link_libraries(verdigris_opencv INTERFACE
  "${OPENCV_IMGPROC_LIBRARY}" "${OPENCV_CORE_LIBRARY}")
