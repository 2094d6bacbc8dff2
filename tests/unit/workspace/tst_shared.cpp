// Guards the basis of undo: values that share unchanged parts (Shared, SharedList, SharedMap) behave like
// plain ones and copy only what is edited.
#include <map>
#include <random>
#include <string>
#include <thread>

#include "tests/unit/suite.h"
#include "ui/workspace/shared_list.h"
#include "ui/workspace/shared_map.h"

using namespace volumen;

namespace {

// Counts copies and comparisons.
struct Counted {
  int value = 0;
  static inline int copies = 0, comparisons = 0;

  Counted() = default;
  Counted(int v) : value(v) {}
  Counted(const Counted& other) : value(other.value) { ++copies; }
  Counted(Counted&&) = default;
  Counted& operator=(const Counted& other) {
    value = other.value;
    ++copies;
    return *this;
  }
  Counted& operator=(Counted&&) = default;
  bool operator==(const Counted& other) const {
    ++comparisons;
    return value == other.value;
  }
};

using Map = SharedMap<int, Counted>;
using List = SharedList<Counted>;

// Returns a map from 0 .. 9 to the same numbers.
Map tenNumbers() {
  Map map;
  for (int n = 0; n < 10; ++n) map.add(n, n);
  return map;
}

List tenInRow() {
  List list;
  for (int n = 0; n < 10; ++n) list.push_back(n);
  return list;
}

}  // namespace

class TestShared : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void writesCopyWhatTheyEdit_data();
  void writesCopyWhatTheyEdit();
  void listsCopyWhatTheyEdit_data();
  void listsCopyWhatTheyEdit();
  void equalIsEqual_data();
  void equalIsEqual();
  void aMapIsAMap_data();
  void aMapIsAMap();
  void aListIsAList();
  void whatIsNotThereIsRefused();
  void copiesAreReadInOtherThreads();
};

void TestShared::writesCopyWhatTheyEdit_data() {
  using Write = std::function<void(Map&)>;
  QTest::addColumn<Write>("write");
  QTest::addColumn<bool>("isShared");  // shared with a copy during the write
  QTest::addColumn<int>("copies");
  QTest::addColumn<bool>("changes");
  const auto row = [](const char* name, const Write& write, bool isShared, int copies, bool changes = true) {
    QTest::newRow(name) << write << isShared << copies << changes;
  };
  const Write edit = [](Map& m) { m.edit(4).value = 44; };
  row("an edit copies one entry", edit, true, 1);
  row("an edit by the only owner copies none", edit, false, 0);
  const Write twice = [](Map& m) { m.edit(4).value = 1, m.edit(4).value = 44, m.edit(4).value = 45; };
  row("what was edited is not copied again", twice, true, 1);
  const Write held = [](Map& m) {
    int& first = m.edit(4).value;
    m.edit(7).value = 77;
    m.erase(9);
    first = 44;
  };
  row("two edits at a time", held, true, 2);
  row(
      "of one that is there", [](Map& m) { m.editOrAdd(4).value = 44; }, true, 1);
  row(
      "erasing copies none", [](Map& m) { m.erase(4); }, true, 0);
  row(
      "clearing copies none", [](Map& m) { m.clear(); }, true, 0);
  row(
      "erasing what is not there", [](Map& m) { m.erase(44); }, true, 0, false);
  row(
      "adding what is there", [](Map& m) { m.add(4, Counted(44)); }, true, 0, false);
  const Write read = [](Map& m) {
    for (const auto& [key, counted] : m) QVERIFY(m.at(key).value == counted.value && m.find(key) != m.end());
  };
  row("reading copies none", read, true, 0, false);
}

void TestShared::writesCopyWhatTheyEdit() {
  using Write = std::function<void(Map&)>;
  QFETCH(Write, write);
  QFETCH(bool, isShared);
  QFETCH(int, copies);
  QFETCH(bool, changes);
  Map map = tenNumbers();
  const Map copy = isShared ? map : Map();
  Counted::copies = 0;
  write(map);
  QCOMPARE(Counted::copies, copies);
  QCOMPARE(map == tenNumbers(), !changes);
  if (isShared) QVERIFY2(copy == tenNumbers(), "a copy is not written to");
}

void TestShared::listsCopyWhatTheyEdit_data() {
  using Write = std::function<void(List&)>;
  QTest::addColumn<Write>("write");
  QTest::addColumn<int>("copies");
  QTest::addColumn<bool>("changes");
  const auto row = [](const char* name, const Write& write, int copies, bool changes = true) {
    QTest::newRow(name) << write << copies << changes;
  };
  row(
      "an edit copies one element", [](List& l) { l.edit(4).value = 44; }, 1);
  row(
      "adding copies none", [](List& l) { l.push_back(10); }, 0);
  row(
      "erasing copies none", [](List& l) { l.eraseIf([](const Counted& c) { return c.value == 4; }); }, 0);
  row(
      "clearing copies none", [](List& l) { l.clear(); }, 0);
  row(
      "erasing nothing", [](List& l) { l.eraseIf([](const Counted&) { return false; }); }, 0, false);
}

void TestShared::listsCopyWhatTheyEdit() {
  using Write = std::function<void(List&)>;
  QFETCH(Write, write);
  QFETCH(int, copies);
  QFETCH(bool, changes);
  List list = tenInRow();
  const List copy = list;
  Counted::copies = 0;
  write(list);
  QCOMPARE(Counted::copies, copies);
  QCOMPARE(list == tenInRow(), !changes);
  QVERIFY2(copy == tenInRow(), "a copy is not written to");
}

void TestShared::equalIsEqual_data() {
  QTest::addColumn<Map>("a");
  QTest::addColumn<Map>("b");
  QTest::addColumn<bool>("areEqual");
  QTest::addColumn<int>("comparisons");  // number of compared elements
  const Map map = tenNumbers();
  Map edited = map, same = map, cleared = map, longer = map;
  edited.edit(4).value = 44;
  same.edit(4).value = 4;
  cleared.clear();
  longer.add(10, 10);
  Map emptied;
  emptied.add(1, 1);
  emptied.erase(1);
  QTest::newRow("a copy: nothing is compared") << map << Map(map) << true << 0;
  QTest::newRow("one entry edited: that is compared") << map << edited << false << 1;
  QTest::newRow("one entry edited to what it was") << map << same << true << 1;
  QTest::newRow("one more") << map << longer << false << 0;
  QTest::newRow("made apart: all are compared") << map << tenNumbers() << true << 10;
  QTest::newRow("none and cleared") << Map() << cleared << true << 0;
  QTest::newRow("none and emptied") << Map() << emptied << true << 0;
}

void TestShared::equalIsEqual() {
  QFETCH(Map, a);
  QFETCH(Map, b);
  QFETCH(bool, areEqual);
  QFETCH(int, comparisons);
  Counted::comparisons = 0;
  QCOMPARE(a == b, areEqual);
  QCOMPARE(Counted::comparisons, comparisons);
}

void TestShared::aMapIsAMap_data() {
  QTest::addColumn<unsigned>("seed");
  for (unsigned seed = 1; seed <= 20; ++seed) QTest::addRow("seed %u", seed) << seed;
}

// After any writes to it and to its copies, it equals a std::map.
void TestShared::aMapIsAMap() {
  QFETCH(unsigned, seed);
  std::mt19937 random(seed);
  const auto below = [&](unsigned n) { return int(random() % n); };
  using Plain = std::map<std::string, int>;
  using Twin = SharedMap<std::string, int>;
  std::vector<std::pair<Twin, Plain>> all(3);
  for (int step = 0; step < 500; ++step) {
    auto& [twin, plain] = all[std::size_t(below(3))];
    const std::string key = "key " + std::to_string(below(20));
    const int value = below(1000);
    const int what = below(20);
    if (what < 6)
      twin.editOrAdd(key) = plain[key] = value;
    else if (what < 10)
      QCOMPARE(twin.add(key, value), plain.try_emplace(key, value).second);
    else if (what < 14)
      QCOMPARE(twin.erase(key), plain.erase(key) == 1);
    else if (what < 17 && plain.contains(key))
      twin.edit(key) = plain.at(key) = value;
    else if (what == 18)
      all[std::size_t(below(3))] = all[std::size_t(below(3))];
    else if (what == 19 && below(10) == 0)
      twin.clear(), plain.clear();
    for (const auto& [a, b] : all) {
      QVERIFY(std::equal(a.begin(), a.end(), b.begin(), b.end()));
      QVERIFY(a.size() == b.size() && a.empty() == b.empty() && a.contains(key) == b.contains(key));
      QCOMPARE(a.find(key) == a.end() ? -1 : a.find(key)->second, b.contains(key) ? b.at(key) : -1);
      QCOMPARE(a == all[0].first, b == all[0].second);
    }
  }
}

void TestShared::aListIsAList() {
  SharedList<std::string> list{"a", "b", "c", "b"};
  const auto holds = [&](const std::vector<std::string>& values) {
    return std::equal(list.begin(), list.end(), values.begin(), values.end()) && list.size() == values.size();
  };
  QVERIFY(holds({"a", "b", "c", "b"}));
  QCOMPARE(std::ranges::find(list, "c") - list.begin(), 2);
  QVERIFY(list.front() == "a" && list.back() == "b" && list[2] == "c");
  QVERIFY(list.eraseIf([](const std::string& s) { return s == "b"; }));
  QVERIFY(holds({"a", "c"}));
  list.assign(std::vector<std::string>{"x", "y"});
  list.edit(1) += "z";
  QVERIFY(holds({"x", "yz"}));
  QVERIFY(SharedList<std::string>(2) == (SharedList<std::string>{"", ""}));
}

void TestShared::whatIsNotThereIsRefused() {
  Map map = tenNumbers();
  QVERIFY_EXCEPTION_THROWN(map.at(44), std::out_of_range);
  QVERIFY_EXCEPTION_THROWN(map.edit(44), std::out_of_range);
  QVERIFY(map == tenNumbers());
}

// Copies are read and dropped in other threads while the original is written here (preset tsan checks it).
void TestShared::copiesAreReadInOtherThreads() {
  SharedMap<int, int> map;
  for (int n = 0; n < 10; ++n) map.add(n, 0);
  for (int round = 1; round <= 200; ++round) {
    int sum = 0;
    std::thread reader([copy = map, &sum]() mutable {
      for (const auto& [key, value] : copy) sum += value;
      copy.clear();
    });
    for (int n = 0; n < 10; ++n) map.edit(n) = round;
    reader.join();
    QCOMPARE(sum, 10 * (round - 1));
  }
}

VOLUMEN_TEST(TestShared);
#include "tst_shared.moc"
