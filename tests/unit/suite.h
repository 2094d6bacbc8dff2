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

/// Runs every registered class, or those that VOLUMEN_ONLY names (A,B), with the arguments of the command
/// line, and `before` ahead of each; returns how many test functions failed, and 1 where a name is none.
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

/// In a tst_*.cpp, after the class: makes it part of its executable.
#define VOLUMEN_TEST(Class) static const volumen::tests::Registered<Class> registered##Class
