#pragma once

#include <QObject>
#include <QTest>
#include <functional>
#include <memory>
#include <vector>

namespace volumen::tests {

/// All test classes of one executable; each registers itself with VOLUMEN_TEST.
inline std::vector<std::function<std::unique_ptr<QObject>()>>& suite() {
  static std::vector<std::function<std::unique_ptr<QObject>()>> classes;
  return classes;
}

template <class Test>
struct Registered {
  Registered() {
    suite().push_back([] { return std::make_unique<Test>(); });
  }
};

/// Runs every registered class, or the one that VOLUMEN_ONLY names, with the arguments of the command line,
/// and `before` ahead of each; returns how many test functions failed.
inline int runSuite(int argc, char** argv, const std::function<void()>& before = {}) {
  const QByteArray only = qgetenv("VOLUMEN_ONLY");
  int failures = 0;
  for (const auto& make : suite()) {
    const std::unique_ptr<QObject> test = make();
    if (!only.isEmpty() && only != test->metaObject()->className()) continue;
    if (before) before();
    failures += QTest::qExec(test.get(), argc, argv);
  }
  return failures;
}

}  // namespace volumen::tests

/// In a tst_*.cpp, after the class: makes it part of its executable.
#define VOLUMEN_TEST(Class) static const volumen::tests::Registered<Class> registered##Class
