// Guards the slices of a series that an archive is sending: those that came are shown until the series is
// complete, and what the user does meanwhile counts more.
#include <QFile>
#include <QSemaphore>

#include "io/open.h"
#include "io/study/frame_series.h"
#include "tests/ui/archives_window.h"
#include "tests/unit/archive/web_peer.h"
#include "ui/views/first_image.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// This archive ("slow", DICOMweb) has one study and sends as many images as it is told to.
class SlowArchive {
 public:
  SlowArchive() {
    DicomSeriesTags tags;
    tags.patientName = "Doe^Jane", tags.patientId = "77", tags.studyUid = "1.2.7";
    tags.studyDescription = "Head", tags.description = "Bone";
    const Result<VolumePtr> volume = makePhantom("ct-head:40");
    const QString folder = dir_.filePath(QStringLiteral("ct"));
    if (!volume || !writeDicomSeries(**volume, tags, folder.toStdString())) return;
    const Result<Study> study = openStudy(folder.toStdString());
    if (study && !study->volumes.empty()) series_ = study->volumes.front();
  }
  ~SlowArchive() { send(1000); }

  Archive archive() const {
    Archive archive;
    archive.name = "slow", archive.kind = ArchiveKind::dicomweb, archive.url = peer_.url().toStdString();
    return archive;
  }
  int images() const { return int(series_.files.size()); }
  void send(int images) { gate_.release(images); }
  /// Ends the line in place of what was not sent.
  void hangUp() {
    isLost_ = true;
    send(1000);
  }

 private:
  static QByteArray entry(const char* tag, const std::string& value) {
    return '"' + QByteArray(tag) + R"(": {"Value": [")" + value.c_str() + "\"]}";
  }
  // The study is not of today: it is listed only where its patient is searched for.
  QByteArray list(const HttpRequest& request) const {
    const QByteArray& path = request.path;
    const QByteArray study = entry("0020000D", "1.2.7"), series = entry("0020000E", series_.id);
    if (path.endsWith("/studies") && !request.query.contains("00100010=*jane*")) return "[]";
    if (path.endsWith("/studies"))
      return "[{" + study + ',' + entry("00081030", "Head") + ',' + entry("00080061", "CT") + ',' +
             R"("00100010": {"Value": [{"Alphabetic": "Doe^Jane"}]}}])";
    if (path.endsWith("/series")) return "[{" + series + ',' + entry("00080060", "CT") + "}]";
    QByteArray all;
    for (const std::string& uid : series_.sopInstanceUids)
      all += (all.isEmpty() ? "{" : ",{") + entry("00080018", uid) + '}';
    return '[' + all + ']';
  }
  QByteArray answerTo(const HttpRequest& request) {
    if (request.query.contains("offset="))
      return jsonAnswer(request.query.contains("offset=0") ? list(request) : QByteArray("[]"));
    const std::string uid = request.path.mid(request.path.lastIndexOf('/') + 1).toStdString();
    const auto image = std::ranges::find(series_.sopInstanceUids, uid);
    if (image == series_.sopInstanceUids.end())  // the series in one answer
      return httpAnswer("406 Not Acceptable", "text/plain", {});
    gate_.acquire();
    if (isLost_) return {};
    QFile file(QString::fromStdString(series_.files[std::size_t(image - series_.sopInstanceUids.begin())]));
    return file.open(QIODevice::ReadOnly) ? partsOf({file.readAll()}) : QByteArray();
  }

  QTemporaryDir dir_;
  Series series_;
  QSemaphore gate_;
  std::atomic<bool> isLost_ = false;
  HttpPeer peer_{[this](const HttpRequest& request) { return answerTo(request); }};
};

// A window that fetches the study of a slow archive.
struct Fetching {
  SlowArchive slow;
  const Studies studies;
  const ListedArchives list{Archives{{slow.archive()}}};
  ArchivesWindow w{studies};

  bool begin() {
    if (slow.images() < 30 || !list.isWritten || !w.choose("slow")) return false;
    w.searchFor("jane");
    const Jobs& jobs = w.window.document().jobs;
    if (!w.has("Head", 4) || !QTest::qWaitFor([&] { return jobs.rows().empty(); }, longest)) return false;
    w.doubleClick(w.row("Head", 4));
    return true;
  }
  FirstImage* image() { return w.child<FirstImage>("firstImage"); }
  /// Sends images until there are so many. Returns whether they are shown.
  bool sendUntil(int shown) {
    slow.send(shown - sent_);
    sent_ = shown;
    return QTest::qWaitFor([&] { return image()->isVisible() && image()->count() == shown; }, longest);
  }
  bool isStudyListShown() { return w.child<QWidget>("studyBrowser")->isVisible(); }

 private:
  int sent_ = 0;
};

}  // namespace

class TestArriving : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { openAlone(); }
  void whatCameIsShownUntilAllIsHere();
  void theImageStaysWhileMoreComes();
  void itEndsWithTheFetch_data();
  void itEndsWithTheFetch();
  void whatIsOpenedMeanwhileStays();
};

void TestArriving::whatCameIsShownUntilAllIsHere() {
  Fetching f;
  QVERIFY(f.begin());
  QTest::qWait(300);  // nothing came: there is nothing to show
  QVERIFY(f.image()->isHidden() && f.isStudyListShown());
  QVERIFY(f.sendUntil(4));
  QVERIFY(!f.isStudyListShown());
  QVERIFY(!f.w.window.session().series());
  QVERIFY(f.image()->count() < f.slow.images());
  f.w.shot("arriving");
  bool wasHidden = false;
  QTimer watch;
  connect(&watch, &QTimer::timeout, f.image(),
          [&] { wasHidden = wasHidden || (f.image()->isHidden() && !f.w.window.session().series()); });
  watch.start(1);
  f.slow.send(1000);
  QVERIFY(f.w.isShown("Bone"));
  QTRY_VERIFY_WITH_TIMEOUT(f.image()->isHidden(), longest);
  QVERIFY(!wasHidden);
  QCOMPARE(frameCount(f.w.window.session().series()->series), f.slow.images());
  QCOMPARE(f.w.window.session().undoStack().count(), 0);
  QCOMPARE(f.w.window.session().workspace().series.size(), std::size_t(1));
}

// The number of the image follows; the wheel reaches what came.
void TestArriving::theImageStaysWhileMoreComes() {
  Fetching f;
  QVERIFY(f.begin());
  QVERIFY(f.sendUntil(6));
  wheel(f.image(), 1000);
  QTRY_COMPARE_WITH_TIMEOUT(f.image()->index(), 0, longest);
  wheel(f.image(), -2);
  QTRY_COMPARE_WITH_TIMEOUT(f.image()->index(), 2, longest);
  const std::string uid = f.image()->sopInstanceUid();
  QVERIFY(!uid.empty());
  QVERIFY(f.sendUntil(10));
  QCOMPARE(f.image()->sopInstanceUid(), uid);
}

void TestArriving::itEndsWithTheFetch_data() {
  QTest::addColumn<bool>("isCancelled");
  QTest::newRow("the user cancels: nothing is opened") << true;
  QTest::newRow("the line is lost: what came is opened") << false;
}

void TestArriving::itEndsWithTheFetch() {
  QFETCH(bool, isCancelled);
  Fetching f;
  QVERIFY(f.begin());
  QVERIFY(f.sendUntil(6));
  if (isCancelled) {
    const std::vector<JobRow> jobs = f.w.window.document().jobs.rows();
    QCOMPARE(jobs.size(), std::size_t(1));
    f.w.window.document().jobs.cancel(jobs[0].id);
  } else {
    f.slow.hangUp();
    QVERIFY(f.w.isShown("Bone"));
  }
  QTRY_VERIFY_WITH_TIMEOUT(f.image()->isHidden(), longest);
  QTRY_COMPARE_WITH_TIMEOUT(f.isStudyListShown(), isCancelled, longest);
}

void TestArriving::whatIsOpenedMeanwhileStays() {
  Fetching f;
  QVERIFY(f.studies.write());
  QVERIFY(f.begin());
  QVERIFY(f.sendUntil(4));
  f.w.window.open({f.studies.data + QStringLiteral("/yamada")});
  QVERIFY(f.w.isShown("Sagittal"));
  for (int n = 0; n < 12; ++n) {
    f.slow.send(1);
    QTest::qWait(50);
    QVERIFY(f.image()->isHidden());
  }
  QVERIFY(f.w.isShown("Sagittal"));
  f.slow.send(1000);
  QVERIFY(f.w.isShown("Bone"));
}

VOLUMEN_TEST(TestArriving);
#include "tst_arriving.moc"
