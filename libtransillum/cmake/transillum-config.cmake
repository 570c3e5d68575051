include("${CMAKE_CURRENT_LIST_DIR}/transillum-targets.cmake")
