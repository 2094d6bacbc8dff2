// Guards archives by DICOMweb, at a fake one: every form of answers and failures that archives are known for.
#include <zlib.h>

#include <QDirIterator>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/web_peer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveWeb : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void answersAreUnderstood_data();
  void answersAreUnderstood();
  void pagesAreTurned_data();
  void pagesAreTurned();
  void failuresAreExplained_data();
  void failuresAreExplained();
  void requestsAreIdentified_data();
  void requestsAreIdentified();
  void instancesAreFetched_data();
  void instancesAreFetched();
  void aTokenIsRenewedWithinAFetch();

 private:
  Outcome archive(const QByteArray& url, const QStringList& words, const QByteArray& more = {}) const;

  QTemporaryDir folder_;
  QList<QByteArray> files_;  // of one series: "1.2.1.1.1", "1.2.1.1.2", "1.2.1.1.3"
};

namespace {

QByteArray oneStudy(const QByteArray& more = {}) {
  return R"([{"0020000D": {"vr": "UI", "Value": ["1.2.1"]},
              "00100020": {"vr": "LO", "Value": ["PID1"]})" +
         more + "}]";
}

QByteArray gzipped(QByteArray text) {
  QByteArray out(text.size() + 1000, '\0');
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(text.data()), stream.avail_in = uInt(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data()), stream.avail_out = uInt(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(qsizetype(stream.total_out));
  deflateEnd(&stream);
  return out;
}

// Bytes of all files below a folder, sorted.
QList<QByteArray> bytesBelow(const QString& folder) {
  QList<QByteArray> all;
  for (QDirIterator files(folder, QDir::Files | QDir::Hidden, QDirIterator::Subdirectories); files.hasNext();)
    all << contentsOf(files.next());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

void TestArchiveWeb::initTestCase() { files_ = instancesOfOneSeries(3); }

Outcome TestArchiveWeb::archive(const QByteArray& url, const QStringList& words,
                                const QByteArray& more) const {
  const QString list = folder_.filePath(QStringLiteral("archives.json"));
  QFile file(list);
  if (file.open(QIODevice::WriteOnly))
    file.write(R"({"archives": [{"name": "web", "kind": "dicomweb", "url": ")" + url + '"' + more + "}]}");
  file.close();
  return runProgram(QStringList{QStringLiteral("archive")} + words +
                    QStringList{QStringLiteral("--archives"), list});
}

void TestArchiveWeb::answersAreUnderstood_data() {
  QTest::addColumn<QByteArray>("answer");
  QTest::addColumn<QByteArray>("field");
  QTest::addColumn<QString>("value");
  const auto row = [](const char* name, const QByteArray& answer, const char* field, const char* value) {
    QTest::newRow(name) << answer << QByteArray(field) << QString::fromUtf8(value);
  };
  const auto name = [](const QByteArray& value) {
    return jsonAnswer(oneStudy(R"(, "00100010": {"vr": "PN", "Value": )" + value + "}"));
  };
  row("a name as groups", name(R"([{"Alphabetic": "Buc^Jérôme", "Ideographic": "山田"}])"), "name",
      "Buc^Jérôme=山田");
  row("a name as a text", name(R"(["Doe^Jane"])"), "name", "Doe^Jane");
  row("a name without an alphabetic group", name(R"([{"Ideographic": "山田"}])"), "name", "=山田");
  row("a value that is no list", name(R"("Doe^Jane")"), "name", "Doe^Jane");
  row("null", name("[null]"), "name", "");
  row("a number", jsonAnswer(oneStudy(R"(, "00201208": {"vr": "IS", "Value": [12]})")), "images", "12");
  row("a number as a text", jsonAnswer(oneStudy(R"(, "00201208": {"vr": "IS", "Value": ["12"]})")), "images",
      "12");
  row("a number with a fraction", jsonAnswer(oneStudy(R"(, "00201208": {"Value": [12.0]})")), "images", "12");
  row("two modalities", jsonAnswer(oneStudy(R"(, "00080061": {"vr": "CS", "Value": ["PT", "CT"]})")),
      "modalities", "CT, PT");
  row("no value", jsonAnswer(oneStudy(R"(, "00081030": {"vr": "LO"})")), "description", "");
  row("gzip", httpAnswer("200 OK", jsonType, gzipped(oneStudy()), "Content-Encoding: gzip\r\n"), "id",
      "PID1");
  row("in chunks",
      "HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\nConnection: close\r\n\r\n" +
          QByteArray::number(oneStudy().size(), 16) + "\r\n" + oneStudy() + "\r\n0\r\n\r\n",
      "id", "PID1");
  row("the end of the connection as the end of the answer", "HTTP/1.0 200 OK\r\n\r\n" + oneStudy(), "id",
      "PID1");
  row("no content", "HTTP/1.1 204 No Content\r\nConnection: close\r\n\r\n", "", "");
  row("an empty answer", jsonAnswer(""), "", "");
  row("an empty list", jsonAnswer("[]"), "", "");
  row("a list of other things", jsonAnswer("[1, null, [], \"x\"]"), "", "");
  row("a study without a UID", jsonAnswer(R"([{"00100020": {"Value": ["PID1"]}}])"), "", "");
  row("another study, as the key is ignored", jsonAnswer(R"([{"0020000D": {"Value": ["1.2.2"]},
       "00100020": {"Value": ["OTHER"]}}])"),
      "", "");
}

void TestArchiveWeb::answersAreUnderstood() {
  QFETCH(QByteArray, answer);
  QFETCH(QByteArray, field);
  QFETCH(QString, value);
  const HttpPeer peer([&](const HttpRequest&) { return answer; });
  const Outcome done = archive(peer.url(), {QStringLiteral("query"), QStringLiteral("web"),
                                            QStringLiteral("pid1"), QStringLiteral("--json")});
  QVERIFY2(done.status == 0, done.err);
  const QJsonArray studies = QJsonDocument::fromJson(done.out)[QStringLiteral("studies")].toArray();
  QCOMPARE(studies.size(), field.isEmpty() ? 0 : 1);
  if (field.isEmpty()) return;
  const QJsonObject study = studies[0].toObject(), patient = study[QStringLiteral("patient")].toObject();
  const QString key = QString::fromLatin1(field);
  QCOMPARE((patient.contains(key) ? patient[key] : study[key]).toVariant().toString(), value);
}

void TestArchiveWeb::pagesAreTurned_data() {
  QTest::addColumn<int>("pageSize");
  QTest::addColumn<bool>("knowsOffset");
  QTest::addColumn<int>("found");
  QTest::newRow("pages of 100") << 100 << true << 250;
  QTest::newRow("pages of 12") << 12 << true << 250;
  QTest::newRow("one page of all") << 250 << true << 250;
  QTest::newRow("an offset that is ignored") << 100 << false << 100;
}

void TestArchiveWeb::pagesAreTurned() {
  QFETCH(int, pageSize);
  QFETCH(bool, knowsOffset);
  QFETCH(int, found);
  const HttpPeer peer([&](const HttpRequest& request) {
    const qsizetype at = request.query.indexOf("offset=");
    const int offset = knowsOffset ? request.query.mid(at + 7).split('&')[0].toInt() : 0;
    QByteArray all;
    for (int n = offset; n < std::min(offset + pageSize, 250); ++n)
      all +=
          (all.isEmpty() ? "" : ",") + (R"({"0020000D": {"Value": ["1.)" + QByteArray::number(n)) + "\"]}}";
    return jsonAnswer("[" + all + "]");
  });
  const Outcome done =
      archive(peer.url(), {QStringLiteral("query"), QStringLiteral("web"), QStringLiteral("--json")});
  QVERIFY2(done.status == 0, done.err);
  QCOMPARE(QJsonDocument::fromJson(done.out)[QStringLiteral("studies")].toArray().size(), found);
}

void TestArchiveWeb::failuresAreExplained_data() {
  QTest::addColumn<QByteArray>("answer");
  QTest::addColumn<QByteArray>("sentence");
  const auto row = [](const char* name, const QByteArray& answer, const char* sentence) {
    QTest::newRow(name) << answer << QByteArray(sentence);
  };
  const auto status = [](const QByteArray& text, const QByteArray& more = {}) {
    return httpAnswer(text, "text/plain", "", more);
  };
  row("no password", status("401 Unauthorized"), "wants a password (401): give \"user\"");
  row("no right", status("403 Forbidden"), "does not allow this (403).");
  row("another service", status("404 Not Found"), "has no DICOMweb services at this URL (404).");
  row("an unknown status", status("418 Teapot"), "answers with status 418.");
  row("too large", status("413 Payload Too Large"), "refuses the search as too large (413)");
  row("busy without end", status("503 Busy"), "is out of order, or busy (503).");
  row("a web page", httpAnswer("200 OK", "text/html; charset=utf-8", "<html>Log in</html>"),
      "answers with a web page: is the URL that of its DICOMweb services?");
  row("no JSON", jsonAnswer("{\"studies\": 1"), "does not answer the search in JSON.");
  row("another host", status("302 Found", "Location: http://127.0.0.2:1/dicom-web/studies\r\n"),
      "redirects to http://127.0.0.2:1, which is refused: correct \"url\".");
  row("another scheme", status("302 Found", "Location: https://127.0.0.1:1/dicom-web/studies\r\n"),
      "redirects to https://127.0.0.1:1, which is refused: correct \"url\".");
  row("a circle", status("302 Found", "Location: studies\r\n"), "redirects in a circle.");
  row("no HTTP", "SSH-2.0-OpenSSH\r\n", "ended the connection.");
  row("an answer that is cut off",
      "HTTP/1.1 200 OK\r\nContent-Type: application/dicom+json\r\nContent-Length: 100\r\n\r\n[{",
      "ended the connection.");
  row("nothing", "", "ended the connection.");
}

void TestArchiveWeb::failuresAreExplained() {
  QFETCH(QByteArray, answer);
  QFETCH(QByteArray, sentence);
  const HttpPeer peer([&](const HttpRequest&) { return answer; });
  const Outcome done = archive(peer.url(), {QStringLiteral("query"), QStringLiteral("web")});
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(sentence), done.err);
  QVERIFY2(done.err.contains(QByteArray("The archive \"web\"")), done.err);
  QCOMPARE(done.err.count('\n'), 1);
}

void TestArchiveWeb::requestsAreIdentified_data() {
  QTest::addColumn<QByteArray>("fields");
  QTest::addColumn<QByteArray>("header");
  QTest::addColumn<QByteArray>("sentence");  // empty: none
  const auto row = [](const char* name, const char* fields, const char* header, const char* sentence) {
    QTest::newRow(name) << QByteArray(fields) << QByteArray(header) << QByteArray(sentence);
  };
  row("a password", R"(, "user": "alice", "passwordCommand": "printf 'se:cret\n'")",
      "Basic YWxpY2U6c2U6Y3JldA==", "");
  row("a token", R"(, "tokenCommand": "echo abc.def")", "Bearer abc.def", "");
  row("a wrong password", R"(, "user": "bob", "passwordCommand": "echo x")", "other",
      "does not accept user and password (401).");
  row("a wrong token", R"(, "tokenCommand": "echo x")", "other", "does not accept the token");
  row("a command that fails", R"(, "tokenCommand": "exit 3")", "",
      "The tokenCommand of the archive \"web\" fails with status 3.");
  row("a command that prints nothing", R"(, "tokenCommand": "true")", "",
      "The tokenCommand of the archive \"web\" must print one line.");
}

void TestArchiveWeb::requestsAreIdentified() {
  QFETCH(QByteArray, fields);
  QFETCH(QByteArray, header);
  QFETCH(QByteArray, sentence);
  const HttpPeer peer([&](const HttpRequest& request) {
    const auto found = request.headers.find("authorization");
    const bool isRight = found != request.headers.end() && found->second == header;
    return isRight ? jsonAnswer("[]") : httpAnswer("401 Unauthorized", "text/plain", "");
  });
  const Outcome done = archive(peer.url(), {QStringLiteral("test"), QStringLiteral("web")}, fields);
  QCOMPARE(done.status, sentence.isEmpty() ? 0 : 1);
  QVERIFY2(done.err.contains(sentence), done.err);
}

void TestArchiveWeb::instancesAreFetched_data() {
  QTest::addColumn<QString>("how");
  QTest::addColumn<int>("status");
  QTest::newRow("as a series") << "series" << 0;
  QTest::newRow("with a short boundary") << "short" << 0;
  QTest::newRow("one by one, in parts") << "one in parts" << 0;
  QTest::newRow("one by one, plain") << "plain" << 0;
  QTest::newRow("without a transfer syntax") << "no syntax" << 0;
  QTest::newRow("cut off in the middle, the rest one by one") << "cut off" << 0;
  QTest::newRow("with others that nobody asked for") << "others" << 0;
  QTest::newRow("one is gone") << "gone" << 3;
  QTest::newRow("one comes without its boundary") << "no boundary" << 3;
  QTest::newRow("one is no DICOM file") << "broken" << 3;
  QTest::newRow("none") << "none" << 1;
}

void TestArchiveWeb::instancesAreFetched() {
  QFETCH(QString, how);
  QFETCH(int, status);
  const auto refused = httpAnswer("406 Not Acceptable", "text/plain", "");
  const HttpPeer peer([&](const HttpRequest& request) -> QByteArray {
    if (isListing(request)) return listing(request);
    const QByteArray accept = request.headers.at("accept");
    const bool isParts = accept.startsWith("multipart"), hasSyntax = accept.contains("transfer-syntax=*");
    if (how == u"none") return httpAnswer("404 Not Found", "text/plain", "");
    if (!request.path.contains("/instances/")) {
      if (how == u"series") return partsOf(files_);
      if (how == u"short") return partsOf(files_, "boundary");
      if (how == u"cut off") return partsOf(files_).left(files_[0].size() + files_[1].size());
      if (how == u"others")
        return partsOf({files_[0], QByteArray(200, 'x'), files_[1], files_[2], files_[2]});
      return refused;
    }
    const int n = request.path.right(1).toInt() - 1;
    if (how == u"gone" && n == 1) return httpAnswer("404 Not Found", "text/plain", "");
    if (how == u"broken" && n == 1) return partsOf({"nothing"});
    if (how == u"no boundary" && n == 1)
      return httpAnswer("200 OK", "multipart/related; boundary=x", QByteArray(100000, 'a'));
    if (how == u"plain")
      return !isParts && hasSyntax ? httpAnswer("200 OK", "application/dicom", files_[n]) : refused;
    if (how == u"no syntax") return isParts && !hasSyntax ? partsOf({files_[n]}) : refused;
    return isParts ? partsOf({files_[n]}) : refused;
  });
  const QString to = folder_.filePath(how);
  const Outcome done = archive(peer.url(), {QStringLiteral("fetch"), QStringLiteral("web"),
                                            QStringLiteral("1.2.1"), QStringLiteral("-o"), to});
  QVERIFY2(done.status == status, done.err);
  QVERIFY2(done.err.isEmpty() == (status == 0), done.err);
  QVERIFY2(status == 0 || done.err.startsWith("volumen: The archive \"web\" "), done.err);
  QList<QByteArray> expected = files_;
  if (status == 3) expected.removeAt(1);
  if (status == 1) expected.clear();
  std::sort(expected.begin(), expected.end());
  QCOMPARE(bytesBelow(to), expected);
}

void TestArchiveWeb::aTokenIsRenewedWithinAFetch() {
  int answers = 0;
  const HttpPeer peer([&](const HttpRequest& request) -> QByteArray {
    // A token is good for three answers.
    const QByteArray good = "Bearer " + QByteArray::number(answers / 3);
    if (request.headers.at("authorization") != good) return httpAnswer("401 Unauthorized", "text/plain", "");
    ++answers;
    if (isListing(request)) return listing(request);
    return request.path.contains("/instances/") ? partsOf({files_[request.path.right(1).toInt() - 1]})
                                                : httpAnswer("406 Not Acceptable", "text/plain", "");
  });
  const QString counter = folder_.filePath(QStringLiteral("counter")),
                to = folder_.filePath(QStringLiteral("renewed"));
  const QByteArray command = "n=$(cat " + counter.toUtf8() + " 2>/dev/null || echo 0); echo $((n + 1)) > " +
                             counter.toUtf8() + "; echo $n";
  const Outcome done = archive(
      peer.url(),
      {QStringLiteral("fetch"), QStringLiteral("web"), QStringLiteral("1.2.1"), QStringLiteral("-o"), to},
      ", \"tokenCommand\": \"" + command + '"');
  QVERIFY2(done.status == 0, done.err);
  QCOMPARE(bytesBelow(to).size(), 3);
}

VOLUMEN_TEST(TestArchiveWeb);
#include "tst_archive_web.moc"
