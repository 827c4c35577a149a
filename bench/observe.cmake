# Included by bench/CMakeLists.txt.
add_executable(observe_clip observe_clip.cpp)
target_link_libraries(observe_clip PRIVATE verdigris::observe)
