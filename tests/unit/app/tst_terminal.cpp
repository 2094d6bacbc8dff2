// Guards design.md 4: whatever names, tags and arguments contain, no command writes terminal control codes,
// and no name starts a line of its own.
#include <QDir>
#include <QFile>
#include <QImage>
#include <QStringDecoder>
#include <QTemporaryDir>
#include <filesystem>
#include <fstream>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;
namespace fs = std::filesystem;

namespace {

// A window title, a bell, a return, a C1 control, a change of direction and a line.
const std::string hostileName =
    "a\x1b]0;own\x07\r\xc2\x9b"
    "31m\xe2\x80\xae\nFORGED";
const std::string hostileTag = "X\x1b[2J\x07\r\xc2\x9bm\xe2\x80\xae";

void replaceAll(std::string& text, const std::string& before, const std::string& after) {
  for (std::size_t at = 0; (at = text.find(before, at)) != std::string::npos; at += after.size())
    text.replace(at, before.size(), after);
}

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

bool isHarmless(const QByteArray& output) {
  QStringDecoder decode(QStringDecoder::Utf8);
  const QString text = decode(output);
  return !decode.hasError() && std::ranges::none_of(text, [](QChar c) {
    const char16_t code = c.unicode();
    return (c.category() == QChar::Other_Control && c != QLatin1Char('\n')) ||
           (code >= 0x200e && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
           (code >= 0x2066 && code <= 0x2069);
  });
}

}  // namespace

class TestTerminal : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void cleanupTestCase();
  void noCommandSteersATerminal_data();
  void noCommandSteersATerminal();

 private:
  std::string at(const std::string& name) const { return folder_.path().toStdString() + "/" + name; }
  QTemporaryDir folder_;
};

// Makes a series with hostile tags, and a volume, segments, a zip archive, a recipe, a scene and shapes with
// hostile names.
void TestTerminal::initTestCase() {
  fs::create_directory(at("in"));
  QVERIFY(runProgram(QStringLiteral("convert phantom:sphere:8 -o %1/in/scans/").arg(folder_.path())).status ==
          0);
  for (const auto& file : fs::directory_iterator(at("in/scans"))) {
    std::string bytes = bytesOf(file.path().string());
    std::string tag = hostileTag;
    tag.resize(std::string("Volumen^Sample").size(), '\x07');
    replaceAll(bytes, "Volumen^Sample", tag);
    tag.resize(std::string("Synthetic phantom").size(), '\x1b');
    replaceAll(bytes, "Synthetic phantom", tag);
    write(file.path().string(), bytes);
  }
  QVERIFY(
      runProgram(QStringLiteral("convert phantom:sphere:8 -o %1/plain.nrrd").arg(folder_.path())).status ==
      0);
  fs::rename(at("plain.nrrd"), at("in/" + hostileName + ".nrrd"));
  write(at("in/" + hostileName + ".txt"), "text");
  write(at("in/" + hostileName + ".dcm"), bytesOf(at("in/scans/slice-00003.dcm")).substr(0, 700));
  QVERIFY(runProgram(
              QStringLiteral("segment phantom:sphere:8 --range 0:99999 -o %1/s.seg.nrrd").arg(folder_.path()))
              .status == 0);
  std::string segments = bytesOf(at("s.seg.nrrd"));
  replaceAll(segments, "Range 0:99999", "R\x1b[2J\x07\xc2\x9b\xe2\x80\xae\x7f!!");
  write(at(hostileName + ".seg.nrrd"), segments);
  const std::string escaped = "a\\u001b[2J\\u0007\\r\\u009b\\u202e\\nFORGED";
  write(at("r.json"), R"({"volumenRecipe": 1, "name": ")" + escaped + R"(", "segments": [{"name": ")" +
                          escaped + R"("}], "steps": [{"step": "range", "segment": ")" + escaped +
                          R"(", "low": 0}]})");
  write(at("bad.json"),
        R"({"volumenRecipe": 1, "name": "A", "segments": [], "steps": [{"step": ")" + escaped + R"("}]})");
  write(at("scene.json"), R"({"volumenScene": 1, "name": ")" + escaped + R"("})");
  write(at("badscene.json"), R"({"volumenScene": 1, ")" + escaped + R"(": 2})");
  write(at("shapes.json"), R"([{"kind": "length", "label": ")" + escaped + R"(", "name": ")" + escaped +
                               R"(", "points": [[0, 0, 0], [1, 1, 1]]}])");
  write(at("bytes\xff\x9b.nrrd"), bytesOf(at("in/" + hostileName + ".nrrd")));
}

// QTemporaryDir cannot remove names that are not UTF-8.
void TestTerminal::cleanupTestCase() {
  for (const auto& entry : fs::directory_iterator(at(""))) fs::remove_all(entry.path());
}

void TestTerminal::noCommandSteersATerminal_data() {
  QTest::addColumn<QString>("line");
  for (const char* line : {"info IN/in",
                           "info IN/in --verbose",
                           "info IN/in --values",
                           "info IN/in --json",
                           "info IN/NAME.nrrd",
                           "info IN/missing-NAME",
                           "info IN",
                           "info IN/in/NAME.nrrd --series NAME",
                           "render IN/in --size 8x8 -o IN/NAME.png",
                           "render IN/in --size 8x8 --scene IN/scene.json --print-scene",
                           "render IN/in --size 8x8 --explain --stats IN/NAME.stats -o IN/a.png",
                           "render IN/in --scene IN/badscene.json -o IN/a.png",
                           "render IN/in --preset NAME -o IN/a.png",
                           "render IN/in --size NAME -o IN/a.png",
                           "render IN/in -o IN/NAME/a.png",
                           "slice IN/in -o IN/NAME.png --print-plane",
                           "slice IN/in --plane frame -o IN/NAME.png",
                           "slice IN/in --presentation NAME --plane frame -o IN/a.png",
                           "convert IN/in -o IN/NAME.nrrd",
                           "convert IN/in/scans -o IN/copy-NAME/",
                           "convert IN/in -o IN/NAME.tiff",
                           "segment IN/in --range 0:9 --json -o IN/NAME.stl",
                           "segment IN/in --recipe IN/r.json -o IN/b.stl",
                           "segment IN/in --recipe IN/r.json --json",
                           "segment IN/in --recipe IN/bad.json",
                           "segment IN/in --recipe NAME",
                           "segment IN/in --from IN/NAME.seg.nrrd",
                           "segment phantom:sphere:8 --from IN/NAME.seg.nrrd --json",
                           "compare IN/NAME.seg.nrrd IN/NAME.seg.nrrd",
                           "compare IN/NAME.seg.nrrd IN/NAME.seg.nrrd --json",
                           "compare IN/NAME.seg.nrrd IN/in/NAME.txt",
                           "measure IN/in --roi IN/shapes.json",
                           "measure IN/in --segments IN/NAME.seg.nrrd",
                           "measure IN/in --roi IN/NAME.json",
                           "accuracy IN/in --knob NAME -o IN/accuracy",
                           "accuracy IN/in --knob step --frames 1 --size 8x8 -o IN/NAME-accuracy",
                           "bench IN/in --size 8x8 --views 1 --rounds 1",
                           "bench IN/in --size 8x8 --views 1 --rounds 1 --json",
                           "import IN/in --index IN/index",
                           "import IN/in --index IN/index --json",
                           "list --index IN/index",
                           "list --series --index IN/index",
                           "list --series --json --index IN/index",
                           "list --index IN/NAME",
                           "forget NAME --index IN/index",
                           "info index:NAME",
                           "open IN/missing-NAME",
                           "NAME",
                           "--NAME",
                           "render IN/in --NAME",
                           "render --list-presets",
                           "segment --list-recipes"})
    QTest::newRow(line) << QString::fromLatin1(line);
}

void TestTerminal::noCommandSteersATerminal() {
  QFETCH(QString, line);
  QStringList words;
  for (QString word : line.split(QLatin1Char(' ')))
    words << word.replace(QLatin1String("IN"), folder_.path())
                 .replace(QLatin1String("NAME"), QString::fromStdString(hostileName));
  const Outcome a = runProgram(words);
  QVERIFY2(a.status >= 0, a.err);
  QVERIFY2(isHarmless(a.out), a.out.toPercentEncoding(" \n/:,."));
  QVERIFY2(isHarmless(a.err), a.err.toPercentEncoding(" \n/:,."));
  QVERIFY2(!a.out.contains("\nFORGED"), a.out);
}

VOLUMEN_TEST(TestTerminal);
#include "tst_terminal.moc"
