// Guards the file of archives: what it may hold, and what each sentence names.
#include <QTemporaryDir>

#include "io/archive/archives.h"
#include "tests/fixtures/program.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestArchivesFile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void problemsAreNamed_data();
  void problemsAreNamed();
  void problemsOfWebArchivesAreNamed_data();
  void problemsOfWebArchivesAreNamed();
  void whatIsWrittenIsReadAgain();
  void aMissingFileHoldsNoArchive();
  void anUnknownNameIsAnsweredWithTheKnownOnes();
};

namespace {

QByteArray archiveWith(const QByteArray& fields) {
  return R"({"archives": [{"name": "main", "kind": "dimse", "host": "localhost", "calledAe": "PACS")" +
         fields + "}]}";
}

}  // namespace

void TestArchivesFile::problemsAreNamed_data() {
  QTest::addColumn<QByteArray>("json");
  QTest::addColumn<QByteArray>("problem");  // empty: it is read
  const auto row = [](const char* name, const QByteArray& json, const char* problem) {
    QTest::newRow(name) << json << QByteArray(problem);
  };
  row("none", "{}", "");
  row("the least", archiveWith(""), "");
  row("all of it",
      archiveWith(
          R"(, "port": 11112, "callingAe": "US", "characterSet": "ISO_IR 100", "tls": {"ca": "ca.pem"})"),
      "");
  row("no JSON", "{", "line 1");
  row("no name", R"({"archives": [{"kind": "dimse", "host": "h", "calledAe": "A"}]})",
      "archives[0].name is missing");
  row("a name that is a path",
      R"({"archives": [{"name": "a/b", "kind": "dimse", "host": "h", "calledAe": "A"}]})",
      "archives[0].name must be 1 to 64 characters without \":\" and \"/\"");
  row("a name twice",
      R"({"archives": [{"name": "a", "kind": "dimse", "host": "h", "calledAe": "A"},
                       {"name": "a", "kind": "dimse", "host": "h", "calledAe": "A"}]})",
      "archives[0].name is used twice: \"a\"");
  row("an unknown kind", R"({"archives": [{"name": "a", "kind": "fax", "host": "h", "calledAe": "A"}]})",
      "archives[0].kind must be \"dimse\" or \"dicomweb\", not \"fax\"");
  row("no host", R"({"archives": [{"name": "a", "kind": "dimse", "calledAe": "A"}]})",
      "archives[0].host is missing");
  row("a host with a port",
      R"({"archives": [{"name": "a", "kind": "dimse", "host": "h:104", "calledAe": "A"}]})",
      "archives[0].host must be a name or an address of up to 56 characters, without a port");
  row("no AE title", R"({"archives": [{"name": "a", "kind": "dimse", "host": "h"}]})",
      "archives[0].calledAe is missing");
  row("an AE title of blanks", archiveWith(R"(, "callingAe": "  ")"),
      "archives[0].callingAe must be an AE title, not empty");
  row("an AE title of 17 characters", archiveWith(R"(, "callingAe": "ABCDEFGHIJKLMNOPQ")"),
      "archives[0].callingAe must have at most 16 characters");
  row("an AE title with a backslash", archiveWith(R"(, "callingAe": "A\\B")"),
      "archives[0].callingAe must be printable ASCII without backslash");
  row("an AE title with an umlaut", archiveWith(R"(, "callingAe": "MÜLLER")"),
      "archives[0].callingAe must be printable ASCII without backslash");
  row("port 0", archiveWith(R"(, "port": 0)"), "archives[0].port must be in 1 .. 65535");
  row("TLS that trusts nobody", archiveWith(R"(, "tls": {})"),
      "archives[0].tls must say by \"pin\" or \"ca\" which certificate the archive has");
  row("a short pin", archiveWith(R"(, "tls": {"pin": "ab"})"),
      "archives[0].tls.pin must have 64 hexadecimal digits");
  row("a certificate without its key", archiveWith(R"(, "tls": {"ca": "c", "certificate": "c"})"),
      "archives[0].tls.key and \"certificate\" belong together");
  row("listening", R"({"listen": {}})", "");
  row("all of listening",
      R"({"listen": {"ae": "US", "port": 1, "address": "0.0.0.0", "peers": ["PACS"], "mostAssociations": 1,
                     "mostMegabytes": 1}})",
      "");
  row("our AE title of 17 characters", R"({"listen": {"ae": "ABCDEFGHIJKLMNOPQ"}})",
      "listen.ae must have at most 16 characters");
  row("listening at port 65536", R"({"listen": {"port": 65536}})", "listen.port must be in 1 .. 65535");
  row("listening at a name", R"({"listen": {"address": "localhost"}})",
      "listen.address must be an IP address of this machine, or 0.0.0.0 or :: for all of them");
  row("a peer that is no text", R"({"listen": {"peers": [1]}})",
      "listen.peers must be a list of up to 1000 AE titles");
  row("a peer of blanks", R"({"listen": {"peers": ["PACS", " "]}})",
      "listen.peers[1] must be an AE title, not empty");
  row("no association at all", R"({"listen": {"mostAssociations": 0}})",
      "listen.mostAssociations must be in 1 .. 1000");
  row("an unknown field", archiveWith(R"(, "password": "secret")"), "archives[0].password");
}

void TestArchivesFile::problemsOfWebArchivesAreNamed_data() {
  QTest::addColumn<QByteArray>("fields");
  QTest::addColumn<QByteArray>("problem");  // empty: it is read
  const auto row = [](const char* name, const char* fields, const char* problem) {
    QTest::newRow(name) << QByteArray(fields) << QByteArray(problem);
  };
  const char* const wrongUrl = "archives[0].url must begin with http:// or https:// and hold neither user";
  row("the least", R"("url": "http://h/dicom-web/")", "");
  row("a password", R"("url": "https://h", "user": "a", "passwordCommand": "pass a")", "");
  row("a token and a certificate",
      R"("url": "https://h", "tokenCommand": "t", "tls": {"certificate": "c", "key": "k"})", "");
  row("no URL", R"("user": "a")", "archives[0].url is missing");
  row("no scheme", R"("url": "h/dicom-web")", wrongUrl);
  row("another scheme", R"("url": "file:///etc")", wrongUrl);
  row("no host", R"("url": "http:///dicom-web")", wrongUrl);
  row("a password in the URL", R"("url": "http://a:secret@h/")", wrongUrl);
  row("a query", R"("url": "http://h/?a=b")", wrongUrl);
  row("a user without a password", R"("url": "http://h", "user": "a")",
      "archives[0].user and \"passwordCommand\" belong together");
  row("a user with a colon", R"("url": "http://h", "user": "a:b", "passwordCommand": "p")",
      "archives[0].user must not hold \":\"");
  row("a token beside a user",
      R"("url": "http://h", "user": "a", "passwordCommand": "p", "tokenCommand": "t")",
      "archives[0].tokenCommand and \"user\" exclude each other");
  row("TLS without https", R"("url": "http://h", "tls": {"ca": "c"})",
      "archives[0].tls needs a URL with https://");
  row("an AE title", R"("url": "http://h", "calledAe": "A")", "archives[0].calledAe");
}

void TestArchivesFile::problemsOfWebArchivesAreNamed() {
  QFETCH(QByteArray, fields);
  QFETCH(QByteArray, problem);
  const auto archives =
      parseArchives((R"({"archives": [{"name": "web", "kind": "dicomweb", )" + fields + "}]}").toStdString());
  QVERIFY2(archives.ok() == problem.isEmpty(), archives ? "" : archives.message().c_str());
  if (archives) {
    const std::string written = archivesToJson(*archives);
    QCOMPARE(parseArchives(written).ok() ? archivesToJson(*parseArchives(written)) : "", written);
    return;
  }
  const QByteArray said = QByteArray::fromStdString(archives.message());
  QVERIFY2(said.contains(problem), said);
  QVERIFY2(!said.contains("secret"), said);
}

void TestArchivesFile::problemsAreNamed() {
  QFETCH(QByteArray, json);
  QFETCH(QByteArray, problem);
  const auto archives = parseArchives(json.toStdString());
  QCOMPARE(archives.ok(), problem.isEmpty());
  if (archives) return;
  const QByteArray said = QByteArray::fromStdString(archives.message());
  QVERIFY2(said.contains(problem), said);
  QVERIFY2(!said.contains("secret"), said);
}

void TestArchivesFile::whatIsWrittenIsReadAgain() {
  Archives all;
  Archive plain;
  plain.name = "main", plain.host = "localhost", plain.calledAe = "PACS";
  Archive full = plain;
  full.name = "Düsseldorf 2", full.port = 11112, full.callingAe = "US", full.characterSet = "ISO_IR 100";
  full.tls = TlsSettings{std::string(64, 'a'), "ca.pem", "our.pem", "key.pem"};
  all.archives = {plain, full};
  all.listen = Listening{"US", 104, "0.0.0.0", {"PACS", "CT 1"}, 4, 100};
  for (Archive& archive : all.archives) archive.listen = all.listen;
  const auto read = parseArchives(archivesToJson(all));
  QVERIFY2(read.ok(), read.ok() ? "" : read.message().c_str());
  QVERIFY(*read == all);
}

void TestArchivesFile::aMissingFileHoldsNoArchive() {
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("none.json")).toStdString();
  const auto none = readArchives(path);
  QVERIFY(none.ok() && none->archives.empty());
  const auto named = archiveNamed(*none, "main", path);
  QCOMPARE(QString::fromStdString(named.message()),
           QStringLiteral("No archive is set up: add one to %1 (man volumen, ARCHIVES). To try one here: "
                          "apt install orthanc (resources/docs/archives.md).")
               .arg(QString::fromStdString(path)));
}

void TestArchivesFile::anUnknownNameIsAnsweredWithTheKnownOnes() {
  const auto all = parseArchives(archiveWith("").toStdString());
  QVERIFY(archiveNamed(*all, "main", "F").ok());
  QCOMPARE(archiveNamed(*all, "mian", "F").message(),
           std::string("There is no archive \"mian\": F lists \"main\"."));
}

VOLUMEN_TEST(TestArchivesFile);
#include "tst_archives_file.moc"
