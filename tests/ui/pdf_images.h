#pragma once

#include <zlib.h>

#include <QByteArray>
#include <QFile>
#include <QImage>
#include <QRectF>
#include <QRegularExpression>
#include <QStringList>
#include <QTransform>
#include <map>
#include <vector>

namespace volumen::tests {

inline QByteArray inflated(const QByteArray& packed) {
  QByteArray out(64 << 20, '\0');
  uLongf size = uLongf(out.size());
  if (uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                 reinterpret_cast<const Bytef*>(packed.constData()), uLong(packed.size())) != Z_OK)
    return {};
  return out.left(qsizetype(size));
}

/// Returns the rectangles of the images in a page's stream, mm from the lower left corner of the paper.
/// Source: PDF 1.4, 8.4.4 (cm, q, Q) and 8.8 (Do).
inline std::vector<QRectF> imagesOfPage(const QByteArray& stream) {
  std::vector<QRectF> images;
  std::vector<QTransform> stack{QTransform()};
  QList<double> numbers;
  for (const QByteArray& word : stream.simplified().split(' ')) {
    bool isNumber = false;
    const double number = word.toDouble(&isNumber);
    if (isNumber) {
      numbers << number;
      continue;
    }
    if (word == "q") stack.push_back(stack.back());
    if (word == "Q" && stack.size() > 1) stack.pop_back();
    if (word == "cm" && numbers.size() >= 6) {
      const double* n = numbers.constData() + numbers.size() - 6;
      stack.back() = QTransform(n[0], n[1], n[2], n[3], n[4], n[5]) * stack.back();
    }
    if (word == "Do") {
      constexpr double mm = 25.4 / 72;
      const QRectF place = stack.back().mapRect(QRectF(0, 0, 1, 1));
      images.emplace_back(place.topLeft() * mm, place.size() * mm);
    }
    numbers.clear();
  }
  return images;
}

/// Returns the image rectangles of all pages of a PDF in order; empty until the file is complete.
inline std::vector<std::vector<QRectF>> pagesIn(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QByteArray pdf = file.readAll();
  if (!pdf.contains("%%EOF")) return {};
  std::vector<std::vector<QRectF>> pages;
  for (qsizetype at = pdf.indexOf("stream\n"); at >= 0; at = pdf.indexOf("stream\n", at)) {
    const qsizetype from = at + 7, to = pdf.indexOf("endstream", from), object = pdf.lastIndexOf("obj", at);
    at = to + 9;
    if (pdf.mid(object, from - object).contains("/Image")) continue;  // pixel data
    std::vector<QRectF> images = imagesOfPage(inflated(pdf.mid(from, to - from)));
    if (!images.empty()) pages.push_back(std::move(images));
  }
  return pages;
}

/// Returns the letters of each font of a PDF by its number, as its tables for copying text map them (PDF 1.4,
/// 5.9.2).
inline std::map<QString, std::map<QString, QString>> lettersIn(const QString& pdf) {
  const auto all = [](const char* pattern, const QString& in) {
    return QRegularExpression(QLatin1String(pattern)).globalMatch(in);
  };
  std::map<QString, std::map<QString, QString>> letters;
  for (auto font = all("(\\d+) 0 obj\\s*<< /Type /Font\\s*/Subtype /Type0[^>]*/ToUnicode (\\d+) 0 R", pdf);
       font.hasNext();) {
    const QRegularExpressionMatch of = font.next();
    const qsizetype from = pdf.indexOf(QStringLiteral("\n%1 0 obj").arg(of.captured(2)));
    const QString map = pdf.mid(from, pdf.indexOf(QLatin1String("endstream"), from) - from);
    for (auto range = all("<(\\w{4})> <\\w{4}> \\[([^\\]]*)\\]", map); range.hasNext();) {
      const QRegularExpressionMatch found = range.next();
      int glyph = found.captured(1).toInt(nullptr, 16);
      for (auto code = all("<(\\w{4})>", found.captured(2)); code.hasNext(); ++glyph)
        letters[of.captured(1)][QStringLiteral("%1").arg(glyph, 4, 16, QLatin1Char('0')).toUpper()] =
            QChar(code.next().captured(1).toInt(nullptr, 16));
    }
  }
  return letters;
}

/// Returns the texts of a PDF written by Qt, each as it was painted.
inline QStringList textsIn(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QByteArray pdf = file.readAll();
  const auto letters = lettersIn(QString::fromLatin1(pdf));
  QStringList texts;
  for (qsizetype at = pdf.indexOf("stream\n"); at >= 0; at = pdf.indexOf("stream\n", at)) {
    const qsizetype from = at + 7, to = pdf.indexOf("endstream", from), object = pdf.lastIndexOf("obj", at);
    at = to + 9;
    if (pdf.mid(object, from - object).contains("/Image")) continue;
    QString font;
    for (const QByteArray& word : inflated(pdf.mid(from, to - from)).simplified().split(' ')) {
      if (word == "BT") texts << QString();
      if (word.startsWith("/F")) font = QString::fromLatin1(word.mid(2));
      if (!word.startsWith('<') || texts.isEmpty() || !letters.contains(font)) continue;
      const auto& of = letters.at(font);
      const auto letter = of.find(QString::fromLatin1(word.mid(1, 4)));
      if (letter != of.end()) texts.back() += letter->second;
    }
  }
  return texts.replaceInStrings(QStringLiteral("\t"), QStringLiteral(" "));  // tab and space share a glyph
}

/// Returns the pixels of all losslessly stored images of a PDF in order (PDF 1.4, 4.8.4).
inline std::vector<QImage> pixelsIn(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QByteArray pdf = file.readAll();
  std::vector<QImage> images;
  for (qsizetype at = pdf.indexOf("stream\n"); at >= 0; at = pdf.indexOf("stream\n", at)) {
    const qsizetype from = at + 7, to = pdf.indexOf("endstream", from), object = pdf.lastIndexOf("obj", at);
    at = to + 9;
    const QByteArray head = pdf.mid(object, from - object).simplified();
    if (!head.contains("/Image")) continue;
    const auto number = [&](const char* key) {
      const qsizetype begin = head.indexOf(key) + qsizetype(qstrlen(key));
      return head.mid(begin, 12).trimmed().split(' ').front().toInt();
    };
    const int width = number("/Width"), height = number("/Height"),
              bytes = head.contains("DeviceRGB") ? 3 : 1;
    const QByteArray samples = inflated(pdf.mid(from, to - from));
    if (samples.size() < qsizetype(bytes) * width * height) continue;
    images.push_back(QImage(reinterpret_cast<const uchar*>(samples.constData()), width, height, bytes * width,
                            bytes == 3 ? QImage::Format_RGB888 : QImage::Format_Grayscale8)
                         .convertToFormat(QImage::Format_RGB32));
  }
  return images;
}

inline std::vector<QRectF> imagesIn(const QString& path) {
  std::vector<QRectF> all;
  for (const std::vector<QRectF>& page : pagesIn(path)) all.insert(all.end(), page.begin(), page.end());
  return all;
}

}  // namespace volumen::tests
