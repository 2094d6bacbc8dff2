#pragma once

#include <QObject>
#include <QTest>
#include <functional>
#include <memory>
#include <vector>

namespace volumen::tests {

/// Returns factories of all test classes of this executable. VOLUMEN_TEST registers a class here.
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

/// Runs every registered class, or those listed in VOLUMEN_ONLY (A,B), with the command line's arguments.
/// `before` is called ahead of each class. Returns the number of failed test functions, plus 1 if a listed
/// name is unknown.
inline int runSuite(int argc, char** argv, const std::function<void()>& before = {}) {
  QByteArrayList wanted = qgetenv("VOLUMEN_ONLY").split(',');
  wanted.removeAll({});
  const bool all = wanted.isEmpty();
  int failures = 0;
  for (const auto& make : suite()) {
    const std::unique_ptr<QObject> test = make();
    if (!all && wanted.removeAll(test->metaObject()->className()) == 0) continue;
    if (before) before();
    failures += QTest::qExec(test.get(), argc, argv);
  }
  for (const QByteArray& name : wanted) qCritical("no test class is called %s", name.constData());
  return failures + (wanted.isEmpty() ? 0 : 1);
}

}  // namespace volumen::tests

/// Adds a class to its executable. Stands after the class in a tst_*.cpp.
#define VOLUMEN_TEST(Class) static const volumen::tests::Registered<Class> registered##Class
