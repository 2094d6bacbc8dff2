#include "io/files/picture_file.h"

#include <QBuffer>
#include <QIODevice>
#include <QImage>
#include <QImageWriter>
#include <QPainter>
#include <new>

#include "io/files/header_text.h"
#include "io/files/nrrd.h"
#include "io/files/output_file.h"

namespace volumen {

namespace {

constexpr int jpegQuality = 95;

// Passes the output of an image writer on to a file, so that it is never in memory as a whole.
class OutputDevice : public QIODevice {
 public:
  explicit OutputDevice(OutputFile& file) : file_(file) { open(QIODevice::WriteOnly); }
  bool isSequential() const override { return true; }
  const Status& written() const { return written_; }

 protected:
  qint64 readData(char*, qint64) override { return -1; }
  qint64 writeData(const char* data, qint64 count) override {
    if (written_) written_ = file_.write(data, std::size_t(count));
    return written_ ? count : -1;
  }

 private:
  OutputFile& file_;
  Status written_;
};

// The Error is Qt's reason.
Status encode(const char* format, const QImage& image, const PictureText& text, QIODevice& device) {
  QImageWriter writer(&device, format);
  if (qstrcmp(format, "jpeg") == 0) writer.setQuality(jpegQuality);
  for (const auto& [key, value] : text)
    writer.setText(QString::fromStdString(key), QString::fromStdString(value));
  if (writer.write(image)) return {};
  return Error{writer.errorString().toStdString()};
}

Status writeAs(const char* format, const QImage& image, const std::string& path, const PictureText& text) {
  auto out = OutputFile::create(path);
  if (!out) return out.error();
  OutputDevice device(*out);
  const Status encoded = encode(format, image, text, device);
  if (!device.written()) return device.written();
  if (!encoded) return Error{"Cannot write " + path + ": " + encoded.message() + "."};
  return out->commit();
}

}  // namespace

QImage imageForFile(const Picture& picture) {
  const std::vector<std::uint8_t> bytes = toBytes(picture);
  const int channels = picture.transparent ? 4 : 3;
  QImage image = QImage(bytes.data(), picture.size.x, picture.size.y, qsizetype(channels) * picture.size.x,
                        picture.transparent ? QImage::Format_RGBA8888 : QImage::Format_RGB888)
                     .copy();
  // Without this the resolution is the screen's, and window and command line would write different files.
  constexpr int dotsPerMetre = 3780;  // 96 an inch
  image.setDotsPerMeterX(dotsPerMetre);
  image.setDotsPerMeterY(dotsPerMetre);
  return image;
}

QImage opaqueImage(const QImage& image) {
  QImage opaque(image.size(), QImage::Format_RGB888);
  if (opaque.isNull()) throw std::bad_alloc();
  opaque.fill(Qt::black);
  QPainter(&opaque).drawImage(0, 0, image);
  return opaque;
}

Result<QByteArray> pngBytes(const QImage& image, const PictureText& text) {
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  if (Status s = encode("png", image, text, buffer); !s) return s.error();
  return buffer.data();
}

Status writeImage(const QImage& image, const std::string& path, const PictureText& text) {
  const QString name = QString::fromStdString(path);
  const bool jpeg = name.endsWith(QStringLiteral(".jpg"), Qt::CaseInsensitive) ||
                    name.endsWith(QStringLiteral(".jpeg"), Qt::CaseInsensitive);
  if (jpeg && image.hasAlphaChannel())
    return Error{path + ": JPEG cannot hold a transparent background; choose PNG or another background."};
  return writeAs(jpeg ? "jpeg" : "png", image, path, text);
}

Status writePng(const Picture& picture, const std::string& path, const PictureText& text) {
  return writeAs("png", imageForFile(picture), path, text);
}

PictureText warningText(const std::vector<Warning>& warnings) {
  std::string lines;
  for (const Warning& w : changingPicture(warnings))
    lines += (lines.empty() ? "" : "\n") + std::string(kindName(w.kind)) + ": " + w.sentence;
  return lines.empty() ? PictureText() : PictureText{{"volumen-warnings", lines}};
}

namespace {

template <class T>
Result<OutputFile> createNrrd(const std::string& header, const std::string& path) {
  auto out = OutputFile::create(path);
  if (!out) return out;
  const std::string type = std::is_same_v<T, float> ? "float" : "uint8";
  if (Status s = out->write("NRRD0005\ntype: " + type + "\n" + header + "\n\n"); !s) return s.error();
  return out;
}

template <class T>
Status writeValues(Result<OutputFile> out, const std::vector<T>& values) {
  if (!out) return out.error();
  if (Status s = out->write(values.data(), values.size() * sizeof(T)); !s) return s;
  return out->commit();
}

std::string sizeText(glm::ivec2 size) { return std::to_string(size.x) + ' ' + std::to_string(size.y); }

}  // namespace

Status writePictureNrrd(const Picture& picture, const std::string& path) {
  const std::string header =
      "dimension: 3\nsizes: 4 " + sizeText(picture.size) +
      "\nkinds: RGBA-color domain domain\nendian: little\nencoding: raw\nbackground:=" +
      (picture.transparent ? "transparent" : "opaque");
  return writeValues(createNrrd<float>(header, path), picture.rgba);
}

Status writeMapNrrd(glm::ivec2 size, const std::vector<float>& values, const std::string& path) {
  return writeValues(createMapNrrd(size, path), values);
}

Result<OutputFile> createMapNrrd(glm::ivec2 size, const std::string& path,
                                 const std::optional<PicturePlane>& plane) {
  const auto vector = [](glm::dvec3 v) {
    return '(' + exactText(v.x) + ',' + exactText(v.y) + ',' + exactText(v.z) + ')';
  };
  std::string header = "dimension: 2\n";
  if (plane) header += "space: left-posterior-superior\n";
  header += "sizes: " + sizeText(size) + "\n";
  if (plane) header += "space directions: " + vector(plane->right) + ' ' + vector(plane->down) + "\n";
  header += "kinds: domain domain\nendian: little\nencoding: raw";
  if (plane) header += "\nspace origin: " + vector(plane->origin);
  return createNrrd<float>(header, path);
}

Status writeColourNrrd(glm::ivec2 size, const std::vector<std::uint8_t>& rgb, const std::string& path) {
  const std::string header =
      "dimension: 3\nsizes: 3 " + sizeText(size) + "\nkinds: RGB-color domain domain\nencoding: raw";
  return writeValues(createNrrd<std::uint8_t>(header, path), rgb);
}

Result<Picture> readPictureNrrd(const std::string& path) {
  auto header = readNrrdFields(path);
  if (!header) return header.error();
  const auto& sizes = header->sizes;
  if (sizes.size() != 3 || sizes[0] != 4 || header->data.type != SampleType::float32 || sizes[1] > 1 << 20 ||
      sizes[2] > 1 << 20)
    return Error{path + " is not a picture of volumen's: float, sizes 4 W H."};
  if (Status s = setCounts(header->data, {}, sizes, {}, path); !s) return s.error();
  std::vector<std::string> warnings;
  auto samples = readSamples(header->data, 0, 1, 0, {}, {}, warnings);
  if (!samples) return samples.error();
  Picture picture;
  picture.size = {int(sizes[1]), int(sizes[2])};
  const auto background = header->keyValues.find("background");
  picture.transparent = background != header->keyValues.end() && background->second == "transparent";
  picture.rgba = std::get<std::vector<float>>(std::move(samples->values));
  return picture;
}

}  // namespace volumen
