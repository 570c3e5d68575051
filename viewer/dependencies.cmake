# Dependencies of the viewer and its tests. Imported targets belong to the folder that finds them,
# so both include this.
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel FiltersSources GUISupportQt InteractionStyle RenderingCore
  RenderingFreeType RenderingOpenGL2)
if(NOT VTK_QT_VERSION)
  set(VTK_QT_VERSION 5)
endif()
set(TRANSILLUM_QT_COMPONENTS Core Gui OpenGL Svg Widgets)
if(VTK_QT_VERSION GREATER_EQUAL 6)
  list(APPEND TRANSILLUM_QT_COMPONENTS OpenGLWidgets)
endif()
if(TRANSILLUM_BUILD_TESTS)
  list(APPEND TRANSILLUM_QT_COMPONENTS Test)
endif()
find_package(Qt${VTK_QT_VERSION} REQUIRED COMPONENTS ${TRANSILLUM_QT_COMPONENTS})
find_package(CLI11 REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(nlohmann_json 3.11 REQUIRED CONFIG)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET libavcodec libavformat libavutil libswscale)
find_package(Threads REQUIRED)
