// Guards surface_file.h: surfaces are written completely or not at all, and readable by other programs. The
// readers here follow the descriptions of the formats.
#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "io/export/surface_file.h"
#include "tests/fixtures/grids.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestSurfaceFile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isReadAsItWas_data();
  void isReadAsItWas();
  void saysItsSpace_data();
  void saysItsSpace();
  void manyTrianglesComeInOrder();
  void severalStandOneAfterTheOther_data();
  void severalStandOneAfterTheOther();
  void groupsHaveTheirNames();
  void whatIsNotWritten_data();
  void whatIsNotWritten();
  void aCancelledOneLeavesWhatWasThere();
};

namespace {

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

template <class T>
T readAt(const QByteArray& bytes, qsizetype at) {
  T value{};
  if (at + qsizetype(sizeof value) <= bytes.size()) std::memcpy(&value, bytes.constData() + at, sizeof value);
  return value;
}

using Corners = std::vector<std::array<glm::vec3, 3>>;

Corners cornersOfAll(const Surface& surface) {
  Corners all;
  for (const auto& t : surface.triangles)
    all.push_back({surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]});
  return all;
}

// Reads binary STL. Returns nothing if the size does not match the number of triangles, or a normal is wrong.
Corners readStl(const QByteArray& bytes) {
  const auto count = readAt<std::uint32_t>(bytes, 80);
  if (bytes.size() != 84 + 50 * qsizetype(count) || bytes.startsWith("solid")) return {};
  Corners all;
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto at = readAt<std::array<glm::vec3, 4>>(bytes, 84 + 50 * qsizetype(t));
    const dvec3 across = glm::cross(dvec3(at[2]) - dvec3(at[1]), dvec3(at[3]) - dvec3(at[1]));
    if (glm::distance(dvec3(at[0]), glm::normalize(across)) > 1e-6) return {};
    all.push_back({at[1], at[2], at[3]});
  }
  return all;
}

Corners readPly(const QByteArray& bytes) {
  const qsizetype body = bytes.indexOf("end_header\n") + 11;
  const QString header = QString::fromLatin1(bytes.left(body));
  const auto numberBehind = [&](const char* word) {
    const QRegularExpression number(QLatin1String(word) + QStringLiteral(" (\\d+)\n"));
    return number.match(header).captured(1).toLongLong();
  };
  const qsizetype points = numberBehind("element vertex"), faces = numberBehind("element face");
  if (!header.startsWith(QLatin1String("ply\nformat binary_little_endian 1.0\n"))) return {};
  if (!header.contains(QLatin1String("property float x\nproperty float y\nproperty float z\nelement face")))
    return {};
  if (!header.contains(QLatin1String("property list uchar int vertex_indices\nend_header"))) return {};
  if (bytes.size() != body + 12 * points + 13 * faces) return {};
  Corners all;
  for (qsizetype f = 0; f < faces; ++f) {
    const qsizetype at = body + 12 * points + 13 * f;
    if (bytes[at] != 3) return {};
    std::array<glm::vec3, 3> corners;
    for (qsizetype n = 0; n < 3; ++n)
      corners[std::size_t(n)] =
          readAt<glm::vec3>(bytes, body + 12 * readAt<std::int32_t>(bytes, at + 1 + 4 * n));
    all.push_back(corners);
  }
  return all;
}

Corners readObj(const QByteArray& bytes) {
  std::vector<glm::vec3> points;
  Corners all;
  for (const QByteArray& line : bytes.split('\n')) {
    const QList<QByteArray> words = line.split(' ');
    if (words[0] == "v") points.emplace_back(words[1].toFloat(), words[2].toFloat(), words[3].toFloat());
    if (words[0] == "f")
      all.push_back({points.at(words[1].toUInt() - 1), points.at(words[2].toUInt() - 1),
                     points.at(words[3].toUInt() - 1)});
  }
  return all;
}

Corners readSurface(const QString& path) {
  const QByteArray bytes = bytesOf(path);
  const QString name = path.toLower();
  if (name.endsWith(QLatin1String(".stl"))) return readStl(bytes);
  return name.endsWith(QLatin1String(".ply")) ? readPly(bytes) : readObj(bytes);
}

// Returns the surface of a block of voxels on a grid of some shape.
Surface blockSurface(const Grid& grid, glm::ivec3 size) {
  OccupancyField field{
      {.size = size, .patientFromVoxelStep = grid.patientFromVoxelStep, .origin = {-120.3, 55, 801}},
      {glm::ivec3(-1), size},
      {}};
  for (int k = -1; k <= size.z; ++k)
    for (int j = -1; j <= size.y; ++j)
      for (int i = -1; i <= size.x; ++i)
        field.values.push_back(i >= 0 && j >= 0 && k >= 0 && i < size.x && j < size.y && k < size.z ? 0.7f
                                                                                                    : 0);
  return *surfaceOf(field);
}

void addEndings() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"bone.stl", "bone.ply", "bone.obj", "Bone 1.STL"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

}  // namespace

void TestSurfaceFile::isReadAsItWas_data() { addEndings(); }

// Every float is exact on every grid. The volume is positive even if a grid is left-handed.
void TestSurfaceFile::isReadAsItWas() {
  QFETCH(QString, name);
  const QTemporaryDir folder;
  const QString path = folder.filePath(name);
  for (const Grid& grid : grids) {
    const Surface surface = blockSurface(grid, {4, 3, 5});
    const Status written = writeSurface(surface, path.toStdString());
    QVERIFY2(written.ok(), written ? "" : written.message().c_str());
    const Corners read = readSurface(path);
    QVERIFY2(read == cornersOfAll(surface), grid.name);
    double volume = 0;
    for (const auto& t : read) {
      const dvec3 a(t[0] - read[0][0]), b(t[1] - read[0][0]), c(t[2] - read[0][0]);
      volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    QVERIFY(volume > 0);
    QVERIFY(std::abs(volume / volumeOf(surface) - 1) < 1e-4);
  }
}

void TestSurfaceFile::saysItsSpace_data() { addEndings(); }

// The words are where Slicer looks for them: STL's header of 80 bytes, a comment of PLY, one of OBJ.
void TestSurfaceFile::saysItsSpace() {
  QFETCH(QString, name);
  const QTemporaryDir folder;
  QVERIFY(writeSurface(blockSurface(grids[0], {2, 2, 2}), folder.filePath(name).toStdString()).ok());
  const QByteArray bytes = bytesOf(folder.filePath(name));
  const QString kind = name.toLower();
  const qsizetype at = bytes.indexOf("SPACE=LPS");
  QVERIFY(at >= 0);
  if (kind.endsWith(QLatin1String("stl"))) QVERIFY(at < 70 && bytes.startsWith("volumen "));
  if (kind.endsWith(QLatin1String("ply")))
    QVERIFY(bytes.left(at).endsWith("\ncomment volumen " VOLUMEN_VERSION " "));
  if (kind.endsWith(QLatin1String("obj"))) QVERIFY(bytes.startsWith("# volumen "));
}

// There are more triangles than one parallel part writes.
void TestSurfaceFile::manyTrianglesComeInOrder() {
  Surface surface = blockSurface(grids[2], {20, 20, 20});
  const auto all = surface.triangles;
  while (surface.triangles.size() < 600000)
    surface.triangles.insert(surface.triangles.end(), all.begin(), all.end());
  const QTemporaryDir folder;
  for (const char* name : {"a.stl", "a.ply", "a.obj"}) {
    const QString path = folder.filePath(QString::fromLatin1(name));
    QVERIFY(writeSurface(surface, path.toStdString()).ok());
    QVERIFY2(readSurface(path) == cornersOfAll(surface), name);
  }
}

void TestSurfaceFile::severalStandOneAfterTheOther_data() { addEndings(); }

void TestSurfaceFile::severalStandOneAfterTheOther() {
  QFETCH(QString, name);
  const Surface all[] = {blockSurface(grids[0], {4, 3, 5}), blockSurface(grids[1], {2, 2, 2}),
                         blockSurface(grids[2], {3, 1, 2})};
  const SurfacePart parts[] = {{"a", &all[0]}, {"b", &all[1]}, {"c", &all[2]}};
  const QTemporaryDir folder;
  QVERIFY(writeSurfaces(parts, folder.filePath(name).toStdString()).ok());
  Corners wanted;
  for (const Surface& surface : all)
    for (const auto& triangle : cornersOfAll(surface)) wanted.push_back(triangle);
  QVERIFY(readSurface(folder.filePath(name)) == wanted);
}

// A single surface has no group.
void TestSurfaceFile::groupsHaveTheirNames() {
  const Surface block = blockSurface(grids[0], {2, 2, 2});
  const SurfacePart parts[] = {{"left lung", &block},
                               {"a\nv 0 0 0", &block},
                               {"Rückenmark", &block},
                               {"left_lung", &block},
                               {"left\tlung", &block}};
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("a.obj"));
  const auto groups = [&](std::span<const SurfacePart> written) {
    if (!writeSurfaces(written, path.toStdString())) return QByteArrayList{"not written"};
    QByteArrayList lines;
    std::size_t faces = 0;
    for (const QByteArray& line : bytesOf(path).split('\n')) {
      if (line.startsWith("f ")) ++faces;
      if (line.startsWith("g ")) lines << line << QByteArray::number(qulonglong(faces));
    }
    return lines;
  };
  const auto times = [&](std::size_t n) {
    return QByteArray::number(qulonglong(n * block.triangles.size()));
  };
  QCOMPARE(groups(parts),
           QByteArrayList({"g left_lung", "0", "g a_v_0_0_0", times(1),
                           "g R\xc3\xbc"
                           "ckenmark",
                           times(2), "g left_lung_(2)", times(3), "g left_lung_(3)", times(4)}));
  QCOMPARE(groups(std::span(parts).first(1)), QByteArrayList());
}

void TestSurfaceFile::whatIsNotWritten_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<bool>("empty");
  QTest::addColumn<QString>("says");
  QTest::newRow("another ending") << "bone.vtk" << false << ": surfaces are written as .stl, .ply or .obj.";
  QTest::newRow("no ending") << "bone" << false << ": surfaces are written as .stl, .ply or .obj.";
  QTest::newRow("nothing to write") << "bone.stl" << true << ": the segment is empty.";
  QTest::newRow("no folder") << "nowhere/bone.stl" << false << ": no such folder.";
}

void TestSurfaceFile::whatIsNotWritten() {
  QFETCH(QString, name);
  QFETCH(bool, empty);
  QFETCH(QString, says);
  const QTemporaryDir folder;
  const QString path = folder.filePath(name);
  const Status written =
      writeSurface(empty ? Surface() : blockSurface(grids[0], {2, 2, 2}), path.toStdString());
  QVERIFY(!written.ok());
  QCOMPARE(QString::fromStdString(written.message()), QStringLiteral("Cannot write ") + path + says);
  QVERIFY(!QFile::exists(path));
}

void TestSurfaceFile::aCancelledOneLeavesWhatWasThere() {
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("bone.ply")).toStdString();
  QVERIFY(writeSurface(blockSurface(grids[0], {2, 2, 2}), path).ok());
  const QByteArray before = bytesOf(QString::fromStdString(path));
  CancelToken cancel;
  cancel.cancel();
  QVERIFY(!writeSurface(blockSurface(grids[1], {3, 3, 3}), path, cancel).ok());
  QCOMPARE(bytesOf(QString::fromStdString(path)), before);
  QCOMPARE(QDir(folder.path()).entryList(QDir::Files | QDir::Hidden).size(), 1);
}

VOLUMEN_TEST(TestSurfaceFile);
#include "tst_surface_file.moc"
