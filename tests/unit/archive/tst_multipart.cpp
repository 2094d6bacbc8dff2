// Guards the reader of messages in parts: what archives write, and broken messages, however they are cut into
// pieces.
#include <random>

#include "io/archive/multipart.h"
#include "tests/unit/suite.h"

using namespace volumen;

class TestMultipart : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void messagesAreRead_data();
  void messagesAreRead();
  void brokenMessagesAreRefused_data();
  void brokenMessagesAreRefused();
  void randomMessagesAreReadInRandomPieces();
};

namespace {

class PartList : public PartSink {
 public:
  Status beginPart() override { return parts.push_back({}), Status(); }
  Status partData(std::string_view bytes) override { return parts.back() += bytes, Status(); }
  Status endPart() override { return ++ended, Status(); }

  std::vector<std::string> parts;
  std::size_t ended = 0;
};

struct ReadMessage {
  std::vector<std::string> parts;  // that ended
  bool isComplete = false;
  std::string problem;
};

ReadMessage readIn(const std::string& type, const std::string& message, std::size_t piece) {
  PartList list;
  auto reader = MultipartReader::of(type, list);
  if (!reader) return {{}, false, reader.message()};
  ReadMessage out;
  for (std::size_t at = 0; at < message.size() && out.problem.empty(); at += piece)
    if (Status s = reader->feed(std::string_view(message).substr(at, piece)); !s) out.problem = s.message();
  out.isComplete = reader->isComplete();
  list.parts.resize(list.ended);
  out.parts = list.parts;
  return out;
}

const std::string related = "multipart/related; type=\"application/dicom\"; boundary=";

}  // namespace

void TestMultipart::messagesAreRead_data() {
  QTest::addColumn<QByteArray>("type");
  QTest::addColumn<QByteArray>("message");
  QTest::addColumn<QList<QByteArray>>("parts");
  const auto row = [](const char* name, const std::string& type, const char* message,
                      const QList<QByteArray>& parts) {
    QTest::newRow(name) << QByteArray::fromStdString(type) << QByteArray(message) << parts;
  };
  const std::string bare = related + "b1";
  row("two parts", bare, "--b1\r\nContent-Type: x\r\n\r\none\r\n--b1\r\n\r\ntwo\r\n--b1--\r\n",
      {"one", "two"});
  row("a quoted boundary", related + "\"b1\"", "--b1\r\n\r\none\r\n--b1--", {"one"});
  row("a type with a semicolon in quotes",
      "Multipart/Related; type=\"application/dicom; boundary=no\"; Boundary=b1", "--b1\r\n\r\none\r\n--b1--",
      {"one"});
  row("text before the first boundary", bare, "ignore --b1 this\r\n--b1\r\n\r\none\r\n--b1--", {"one"});
  row("a line end before the first boundary", bare, "\r\n--b1\r\n\r\none\r\n--b1--", {"one"});
  row("lines without carriage returns", bare, "--b1\nA: b\n\none\n--b1--\n", {"one"});
  row("blanks after the boundary", bare, "--b1 \t\r\n\r\none\r\n--b1--", {"one"});
  row("one line end too many", bare, "--b1\r\nA: b\r\n\r\n\r\none\r\n--b1--", {"one"});
  row("an empty part", bare, "--b1\r\nA: b\r\n\r\n\r\n--b1--", {""});
  row("data that begin as the boundary does", bare, "--b1\r\n\r\na\r\n--b2\r\n--b\r\n--b1x\r\n--b1--",
      {"a\r\n--b2\r\n--b\r\n--b1x"});
  row("data that hold a short boundary, with their length", bare,
      "--b1\r\nContent-Length: 9\r\n\r\na\r\n--b1\r\n\r\n--b1--", {"a\r\n--b1\r\n"});
  row("a length that is too small", bare, "--b1\r\ncontent-length: 2\r\n\r\nabcdef\r\n--b1--", {"abcdef"});
  row("a length that lies beside a long boundary", related + "0123456789abcdef0123",
      "--0123456789abcdef0123\r\nContent-Length: 999999\r\n\r\nabc\r\n--0123456789abcdef0123--", {"abc"});
  row("text after the last boundary", bare, "--b1\r\n\r\none\r\n--b1--\r\nignored\r\n--b1\r\n", {"one"});
  row("carriage returns at the end of data", bare, "--b1\r\n\r\none\r\r\n--b1--", {"one\r"});
  row("no part", bare, "--b1--", {});
}

void TestMultipart::messagesAreRead() {
  QFETCH(QByteArray, type);
  QFETCH(QByteArray, message);
  QFETCH(QList<QByteArray>, parts);
  for (std::size_t piece = 1; piece <= std::size_t(message.size()); ++piece) {
    const ReadMessage read = readIn(type.toStdString(), message.toStdString(), piece);
    QCOMPARE(QByteArray::fromStdString(read.problem), QByteArray());
    QVERIFY(read.isComplete);
    QList<QByteArray> found;
    for (const std::string& part : read.parts) found << QByteArray::fromStdString(part);
    QCOMPARE(found, parts);
  }
}

void TestMultipart::brokenMessagesAreRefused_data() {
  QTest::addColumn<QByteArray>("type");
  QTest::addColumn<QByteArray>("message");
  QTest::addColumn<QByteArray>("problem");  // empty: it is only not complete
  const QByteArray bare = QByteArray::fromStdString(related) + "b1";
  QTest::newRow("one part alone") << QByteArray("application/dicom") << QByteArray("x")
                                  << QByteArray("no message of several parts");
  QTest::newRow("no boundary") << QByteArray("multipart/related; type=x") << QByteArray("x")
                               << QByteArray("a message without a boundary of its parts");
  QTest::newRow("a boundary that is too long")
      << QByteArray("multipart/related; boundary=" + QByteArray(300, 'b')) << QByteArray("x")
      << QByteArray("a message without a boundary of its parts");
  QTest::newRow("another boundary") << bare << QByteArray(100000, 'x')
                                    << QByteArray("a message without its boundary");
  QTest::newRow("headers without end") << bare << "--b1\r\n" + QByteArray("A: b\r\n").repeated(20000)
                                       << QByteArray("a part whose headers do not end");
  QTest::newRow("a header without end")
      << bare << "--b1\r\n" + QByteArray(100000, 'x') << QByteArray("a part whose headers do not end");
  QTest::newRow("a boundary without end")
      << bare << "--b1" + QByteArray(100000, ' ') << QByteArray("a broken boundary");
  QTest::newRow("cut off in data") << bare << QByteArray("--b1\r\n\r\none\r\n") << QByteArray();
  QTest::newRow("cut off in the last boundary")
      << bare << QByteArray("--b1\r\n\r\none\r\n--b1-") << QByteArray();
  QTest::newRow("cut off before the length")
      << bare << QByteArray("--b1\r\nContent-Length: 9\r\n\r\none\r\n--b1--") << QByteArray();
  QTest::newRow("empty") << bare << QByteArray() << QByteArray();
}

void TestMultipart::brokenMessagesAreRefused() {
  QFETCH(QByteArray, type);
  QFETCH(QByteArray, message);
  QFETCH(QByteArray, problem);
  for (const std::size_t piece : {1, 7, 1000000}) {
    const ReadMessage read = readIn(type.toStdString(), message.toStdString(), piece);
    QCOMPARE(QByteArray::fromStdString(read.problem), problem);
    QVERIFY(!read.isComplete);
    QVERIFY(read.parts.empty());
  }
}

// Data of line ends, hyphens and the boundary's letters, as they are hardest to tell from it.
void TestMultipart::randomMessagesAreReadInRandomPieces() {
  std::mt19937 random(20261130);
  const auto below = [&](std::size_t n) { return std::size_t(random() % n); };
  const std::string boundary = "abcdefghijklmnopq";
  for (int n = 0; n < 3000; ++n) {
    std::vector<std::string> parts(below(4));
    std::string message = below(2) ? "" : "preamble\r\n";
    for (std::string& part : parts) {
      for (std::size_t length = below(60); length > 0; --length) {
        static const std::string pieces[] = {"\r", "\n", "-", "--", "\r\n--", "a", "abcdefghijklmnop", "x"};
        part += pieces[below(std::size(pieces))];
      }
      if (part.starts_with("\r\n")) part.insert(0, "x");  // such a line end is dropped
      message += "--" + boundary + (below(2) ? "\r\n" : "\n") + (below(2) ? "" : "Content-Type: a\r\n") +
                 "\r\n" + part + "\r\n";
    }
    message += "--" + boundary + "--";
    PartList list;
    auto reader = MultipartReader::of("multipart/related; boundary=" + boundary, list);
    for (std::size_t at = 0; at < message.size();) {
      const std::size_t piece = 1 + below(30);
      QVERIFY(reader->feed(std::string_view(message).substr(at, piece)));
      at += piece;
    }
    QVERIFY(reader->isComplete());
    QCOMPARE(list.ended, parts.size());
    QVERIFY2(list.parts == parts, message.c_str());
  }
}

VOLUMEN_TEST(TestMultipart);
#include "tst_multipart.moc"
