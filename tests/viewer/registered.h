// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// All tests of the viewer are one program, so that the headers of Qt and VTK are read once for
// several of them and nothing is linked 40 times. Each is run in a process of its own.
#pragma once

#include <QCoreApplication>
#include <QTest>

namespace transillum::viewer::test {

/// Runs a test with the arguments of its process, and returns the number of failures.
using TestMain = int (*)(int argc, char** argv);

/// A test of this program by its name: the name of its file, without `_test.cpp`.
struct Registered {
  Registered(const char* name, TestMain run);
};

template <class Test>
int run_without_application(int argc, char** argv) {
  Test test;
  return QTest::qExec(&test, argc, argv);
}

template <class Test>
int run_without_widgets(int argc, char** argv) {
  QCoreApplication application(argc, argv);
  return run_without_application<Test>(argc, argv);
}

}  // namespace transillum::viewer::test
