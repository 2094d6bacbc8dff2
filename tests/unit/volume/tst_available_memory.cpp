// Guards the available memory: the least of what the machine, control groups and `ulimit` leave. Threads
// follow the quotas of control groups likewise.
#include <sys/resource.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>
#include <algorithm>
#include <fstream>
#include <map>

#include "io/worker/sandbox.h"
#include "tests/unit/suite.h"
#include "viewer/volume/available_memory.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/control_groups.h"

using namespace volumen;

namespace {

using Files = std::map<std::string, std::string>;  // texts by file name
constexpr std::uint64_t mebi = 1 << 20;

Files with(Files files, const Files& others) {
  for (const auto& [name, text] : others) files[name] = text;
  return files;
}

// A machine of 8,000 MiB with 5,000 available, without groups and limits. The process uses 300 MiB of address
// space and 100 MiB of data.
const Files noLimits = {
    {"proc/meminfo",
     "MemTotal:  8192000 kB\nMemFree: 1024000 kB\nMemAvailable: 5120000 kB\nCached: 2048000 kB\n"},
    {"proc/self/status", "Name:\tvolumen\nVmSize:\t  307200 kB\nVmData:\t  102400 kB\n"},
    {"proc/self/limits",
     "Limit                     Soft Limit           Hard Limit           Units     \n"
     "Max data size             unlimited            unlimited            bytes     \n"
     "Max address space         unlimited            unlimited            bytes     \n"}};

std::string limitLine(const char* name, std::uint64_t bytes) {
  return std::string(name) + "  " + std::to_string(bytes) + "  unlimited  bytes\n";
}

std::string inBytes(std::uint64_t mebibytes) { return std::to_string(mebibytes * mebi) + "\n"; }

// Returns the files of a control group of version 1 or 2 with its limit, usage and page cache, in MiB.
Files group(const std::string& path, bool version2, std::uint64_t limit, std::uint64_t used,
            std::uint64_t cached) {
  const std::string half = inBytes(cached / 2);
  if (version2)
    return {{path + "/memory.max", inBytes(limit)},
            {path + "/memory.current", inBytes(used)},
            {path + "/memory.stat", "anon 1\ninactive_file " + half + "active_file " + half}};
  return {
      {path + "/memory.limit_in_bytes", inBytes(limit)},
      {path + "/memory.usage_in_bytes", inBytes(used)},
      {path + "/memory.stat", "inactive_file 1\ntotal_inactive_file " + half + "total_active_file " + half}};
}

// Returns the files that name the mount point, the group at its root, and the group of the process.
Files tree(bool version2, const std::string& rootGroup, const std::string& ownGroup) {
  const std::string mounted = version2
                                  ? " /sys/fs/cgroup rw - cgroup2 cgroup2 rw"
                                  : " /sys/fs/cgroup/memory rw,relatime shared:9 - cgroup cgroup rw,memory";
  return {{"proc/self/mountinfo",
           "31 23 0:28 / /proc rw - proc proc rw\n35 31 0:32 " + rootGroup + mounted + "\n"},
          {"proc/self/cgroup", (version2 ? "0::" : "8:pids:/other\n4:memory:") + ownGroup + "\n"}};
}

bool write(const Files& files, const QTemporaryDir& root) {
  return std::ranges::all_of(files, [&](const auto& file) {
    const QString path = root.filePath(QString::fromStdString(file.first));
    QFile made(path);
    return QDir().mkpath(QFileInfo(path).path()) && made.open(QIODevice::WriteOnly) &&
           made.write(file.second.c_str()) == qint64(file.second.size());
  });
}

const std::string v1 = "sys/fs/cgroup/memory", v2 = "sys/fs/cgroup";

}  // namespace

class TestAvailableMemory : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isTheLeastThatIsLeft_data();
  void isTheLeastThatIsLeft();
  void threadsFollowTheQuotas_data();
  void threadsFollowTheQuotas();
  void followsTheLimitOfThisProcess();
  void textsHaveWholeMebibytes_data();
  void textsHaveWholeMebibytes();
  void whatIsNotThereIsNotGiven();
};

void TestAvailableMemory::isTheLeastThatIsLeft_data() {
  QTest::addColumn<Files>("files");
  QTest::addColumn<int>("available");
  QTest::addColumn<int>("most");
  QTest::addColumn<MemoryBound>("bound");
  const auto row = [](const std::string& name, const Files& files, int available, int most,
                      MemoryBound bound) {
    QTest::newRow(name.c_str()) << files << available << most << bound;
  };
  using enum MemoryBound;
  row("the machine alone", noLimits, 5000, 8000, machine);
  row("a kernel that does not estimate it",
      with(noLimits, {{"proc/meminfo", "MemTotal:  8192000 kB\nMemFree: 1024000 kB\nCached: 2048000 kB\n"}}),
      3000, 8000, machine);
  row("ulimit -v", with(noLimits, {{"proc/self/limits", limitLine("Max address space", 1000 * mebi)}}), 700,
      1000, addressSpace);
  row("ulimit -v that is used up",
      with(noLimits, {{"proc/self/limits", limitLine("Max address space", 200 * mebi)}}), 0, 200,
      addressSpace);
  row("ulimit -d", with(noLimits, {{"proc/self/limits", limitLine("Max data size", 1000 * mebi)}}), 900, 1000,
      data);
  for (bool second : {false, true}) {
    const std::string version = second ? "version 2: " : "version 1: ";
    const std::string at = second ? v2 : v1;
    const auto rowOf = [&](const char* name, const Files& groups, int available, int most,
                           MemoryBound bound) {
      row(version + name, with(noLimits, groups), available, most, bound);
    };
    const Files own = with(tree(second, "/", "/a/b"), group(at + "/a/b", second, 2000, 900, 300));
    rowOf("a group, its page cache not counted", own, 1400, 2000, controlGroup);
    rowOf("a parent with less", with(own, group(at + "/a", second, 1500, 1200, 0)), 300, 1500, controlGroup);
    rowOf("a parent with more", with(own, group(at + "/a", second, 6000, 1200, 0)), 1400, 2000, controlGroup);
    rowOf("a container sees its group as the root",
          with(tree(second, "/docker/c1", "/docker/c1"), group(at, second, 2000, 900, 0)), 1100, 2000,
          controlGroup);
    rowOf("a group that is not seen from here",
          with(tree(second, "/", "/../../x"), group(at, second, 2000, 900, 0)), 1100, 2000, controlGroup);
    rowOf("a limit above the machine", with(tree(second, "/", "/"), group(at, second, 1 << 23, 900, 0)), 5000,
          8000, machine);
    rowOf("more used than is allowed", with(tree(second, "/", "/"), group(at, second, 1000, 1100, 0)), 0,
          1000, controlGroup);
  }
  row("version 2 without a limit",
      with(noLimits,
           with(tree(true, "/", "/a"), {{v2 + "/a/memory.max", "max\n"}, {v2 + "/a/memory.current", "1\n"}})),
      5000, 8000, machine);
}

void TestAvailableMemory::isTheLeastThatIsLeft() {
  QFETCH(Files, files);
  QTemporaryDir root;
  QVERIFY(write(files, root));
  const ProcessMemory memory = processMemory(root.path().toStdString());
  QTEST(int(memory.available / mebi), "available");
  QTEST(int(memory.most / mebi), "most");
  QTEST(memory.bound, "bound");
}

void TestAvailableMemory::threadsFollowTheQuotas_data() {
  QTest::addColumn<Files>("files");
  QTest::addColumn<int>("threads");
  const auto row = [](const char* name, const Files& files, int threads) {
    QTest::newRow(name) << files << threads;
  };
  constexpr int unlimited = 1 << 20;
  const Files two = {{"proc/self/mountinfo", "35 31 0:32 / /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n"},
                     {"proc/self/cgroup", "0::/a/b\n"}};
  row("no groups", {}, unlimited);
  row("version 2 without a quota", with(two, {{v2 + "/a/b/cpu.max", "max 100000\n"}}), unlimited);
  row("version 2, the quota of the own group", with(two, {{v2 + "/a/b/cpu.max", "250000 100000\n"}}), 3);
  row("version 2, a parent with less",
      with(two, {{v2 + "/a/b/cpu.max", "800000 100000\n"}, {v2 + "/a/cpu.max", "200000 100000\n"}}), 2);
  row("version 2, a part of a processor", with(two, {{v2 + "/a/b/cpu.max", "20000 100000\n"}}), 1);
  const Files one = {
      {"proc/self/mountinfo", "35 31 0:32 / /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup rw,cpu,cpuacct\n"},
      {"proc/self/cgroup", "5:memory:/other\n3:cpu,cpuacct:/a\n"}};
  const std::string own = "sys/fs/cgroup/cpu,cpuacct/a";
  row("version 1 without a quota",
      with(one, {{own + "/cpu.cfs_quota_us", "-1\n"}, {own + "/cpu.cfs_period_us", "100000\n"}}), unlimited);
  row("version 1",
      with(one, {{own + "/cpu.cfs_quota_us", "150000\n"}, {own + "/cpu.cfs_period_us", "50000\n"}}), 3);
}

void TestAvailableMemory::threadsFollowTheQuotas() {
  QFETCH(Files, files);
  QTemporaryDir root;
  QVERIFY(write(files, root));
  QTEST(threadsOfControlGroups(root.path().toStdString()), "threads");
}

void TestAvailableMemory::followsTheLimitOfThisProcess() {
  if (worker::sanitized) QSKIP("sanitizers take terabytes of addresses");
  const ProcessMemory before = processMemory();
  QVERIFY(before.available > 0 && before.available <= before.most);
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit old{};
  QVERIFY(::getrlimit(RLIMIT_AS, &old) == 0);
  rlimit low = old;
  low.rlim_cur = rlim_t(pages) * rlim_t(sysconf(_SC_PAGESIZE)) + 64 * mebi;
  QVERIFY(::setrlimit(RLIMIT_AS, &low) == 0);
  const ProcessMemory short64 = processMemory();
  QVERIFY(::setrlimit(RLIMIT_AS, &old) == 0);
  QVERIFY(short64.available <= 64 * mebi);
  QCOMPARE(short64.most, std::uint64_t(low.rlim_cur));
  QCOMPARE(short64.bound, MemoryBound::addressSpace);
}

void TestAvailableMemory::textsHaveWholeMebibytes_data() {
  QTest::addColumn<std::uint64_t>("bytes");
  QTest::addColumn<QString>("text");
  QTest::newRow("none") << std::uint64_t(0) << QStringLiteral("0 MiB");
  QTest::newRow("begun ones count") << 640 * mebi - 1 << QStringLiteral("640 MiB");
  QTest::newRow("up to 1 GiB") << 1023 * mebi << QStringLiteral("1023 MiB");
  QTest::newRow("1 GiB") << 1024 * mebi << QStringLiteral("1.0 GiB");
  QTest::newRow("begun tenths count") << 5200 * mebi << QStringLiteral("5.1 GiB");
}

void TestAvailableMemory::textsHaveWholeMebibytes() {
  QFETCH(std::uint64_t, bytes);
  QTEST(QString::fromStdString(memoryText(bytes)), "text");
}

void TestAvailableMemory::whatIsNotThereIsNotGiven() {
  QVERIFY(checkAvailable("a.nrrd: reading it", 1));
  const Status s = checkAvailable("a.nrrd: reading it", std::uint64_t(1) << 60);
  QVERIFY(!s);
  QVERIFY2(s.message().starts_with("a.nrrd: reading it needs 1073741824.1 GiB of memory, and "),
           s.message().c_str());
  QVERIFY_THROWS_EXCEPTION(std::bad_alloc, expectAvailable(std::uint64_t(1) << 60));
  QVERIFY_THROWS_EXCEPTION(std::bad_alloc, Buffer<float>(std::size_t(1) << 44));
  QVERIFY_THROWS_EXCEPTION(std::bad_alloc, zeros<float>(std::size_t(1) << 44));
}

VOLUMEN_TEST(TestAvailableMemory);
#include "tst_available_memory.moc"
