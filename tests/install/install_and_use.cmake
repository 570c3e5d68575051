# Installs the build BUILD_DIR to a prefix in WORK_DIR, then configures, builds and runs the consumer
# in SOURCE_DIR against the installed package. Run by ctest with cmake -P.
function(run_step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGV}\n${output}")
  endif()
endfunction()

set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})
run_step(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run_step(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
         -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
         -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
run_step(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run_step(${WORK_DIR}/build/consumer)
# The installed program finds the installed library.
run_step(${prefix}/bin/transillum --version)

# Its exports, and where programs look for it.
file(GLOB_RECURSE LIBRARY ${prefix}/lib*/libtransillum.so)
file(GLOB PROGRAMS ${prefix}/bin/*)
include(${CMAKE_CURRENT_LIST_DIR}/check_exports.cmake)

# The same consumer by pkg-config.
file(GLOB_RECURSE pc ${prefix}/lib*/transillum.pc)
cmake_path(GET pc PARENT_PATH pc_folder)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
execute_process(COMMAND pkg-config --cflags --libs transillum OUTPUT_VARIABLE flags
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND pkg-config --modversion transillum OUTPUT_VARIABLE version
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT version STREQUAL VERSION)
  message(FATAL_ERROR "transillum.pc has version ${version}, not ${VERSION}")
endif()
separate_arguments(flags UNIX_COMMAND "${CXX_FLAGS} ${flags}")
cmake_path(GET LIBRARY PARENT_PATH library_folder)
run_step(${CXX_COMPILER} -std=c++20 ${SOURCE_DIR}/consumer.cpp -o ${WORK_DIR}/by_pkg_config ${flags}
         -Wl,-rpath,${library_folder})
run_step(${WORK_DIR}/by_pkg_config)

# The packages, the citation and the Python module have the same version.
file(STRINGS ${SOURCE_DIR}/../../debian/changelog changelog LIMIT_COUNT 1)
if(NOT changelog MATCHES "^transillum \\(${VERSION}\\)")
  message(FATAL_ERROR "debian/changelog begins with \"${changelog}\", not with version ${VERSION}")
endif()
foreach(file IN ITEMS CITATION.cff libtransillum/python/pyproject.toml)
  file(STRINGS ${SOURCE_DIR}/../../${file} version REGEX "^version(:| =)")
  if(NOT version MATCHES "[ \"]${VERSION}\"?$")
    message(FATAL_ERROR "${file} says \"${version}\", not version ${VERSION}")
  endif()
endforeach()
