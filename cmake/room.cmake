# A room is one folder of the library. This function is the layer rule: a room links exactly the
# rooms in DEPENDS, and the row is recorded so that tests/layers can hold every #include to it.
#
#   verdigris_add_room(forecast
#     HEADERS forecast.h affine.h          # public, self-contained, verified
#     SOURCES affine.cpp                   # listed, never globbed
#     TESTS affine_test.cpp                # one test program per room
#     DEPENDS observe files color pixels   # rooms
#     LIBRARIES hwy::hwy)                  # anything else, linked privately
set(VERDIGRIS_LAYERS_FILE "${CMAKE_BINARY_DIR}/layers.txt")
file(WRITE "${VERDIGRIS_LAYERS_FILE}" "")

add_library(verdigris_house INTERFACE)  # error.h, status.h, progress.h: every room may use them
target_include_directories(verdigris_house INTERFACE "${CMAKE_SOURCE_DIR}")

# The row of a room that this build leaves out: its includes are held to it all the same.
function(verdigris_record_room name)
  file(APPEND "${VERDIGRIS_LAYERS_FILE}" "${name}: ${ARGN}\n")
endfunction()

function(verdigris_add_room name)
  cmake_parse_arguments(ROOM "" "" "HEADERS;SOURCES;TESTS;DEPENDS;LIBRARIES;TEST_LIBRARIES" ${ARGN})
  set(target verdigris_${name})
  add_library(${target} STATIC ${ROOM_SOURCES})
  add_library(verdigris::${name} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS "${CMAKE_SOURCE_DIR}"
                 FILES ${ROOM_HEADERS})
  target_link_libraries(${target} PUBLIC verdigris_house)
  foreach(room IN LISTS ROOM_DEPENDS)
    target_link_libraries(${target} PUBLIC verdigris_${room})
  endforeach()
  target_link_libraries(${target} PRIVATE ${ROOM_LIBRARIES})
  verdigris_record_room(${name} ${ROOM_DEPENDS})

  if(VERDIGRIS_BUILD_TESTS AND ROOM_TESTS)
    add_executable(${target}_test ${ROOM_TESTS})
    target_link_libraries(${target}_test PRIVATE ${target} ${ROOM_TEST_LIBRARIES}
                          GTest::gtest GTest::gtest_main)
    target_compile_definitions(${target}_test PRIVATE
      VERDIGRIS_SHARED_DATA="${VERDIGRIS_SHARED_DATA}")
    gtest_discover_tests(${target}_test TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
                         PROPERTIES LABELS ${name} TIMEOUT 300)
  endif()
endfunction()
