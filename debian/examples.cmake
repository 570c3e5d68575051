# The examples of libtransillum, with the installed package:
#   cp -r /usr/share/doc/libtransillum-dev/examples . && cmake -S examples -B build && cmake --build build
cmake_minimum_required(VERSION 3.22)
project(transillum_examples LANGUAGES CXX)

find_package(transillum 0.1 CONFIG REQUIRED)

file(GLOB sources ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
foreach(source IN LISTS sources)
  cmake_path(GET source STEM name)
  add_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE transillum::transillum)
endforeach()
