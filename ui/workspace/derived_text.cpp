#include "ui/workspace/derived_text.h"

#include <algorithm>

#include "results/text/text.h"

namespace volumen {

namespace {

QString kindNameOf(DerivedKind kind) {
  switch (kind) {
    case DerivedKind::presentation:
      return tr("Presentation state");
    case DerivedKind::keyObjects:
      return tr("Key objects");
    case DerivedKind::report:
      return tr("Report");
    case DerivedKind::contours:
      return tr("Contours");
    case DerivedKind::segmentation:
      return tr("Segmentation");
  }
  return {};
}

QString notHereText(std::size_t notHere, std::size_t all) {
  if (notHere == 0) return {};
  if (all == 1) return tr("its picture is not here");
  if (notHere == all) return tr("none of its %1 pictures is here").arg(all);
  return notHere == 1 ? tr("1 of %1 pictures is not here").arg(all)
                      : tr("%1 of %2 pictures are not here").arg(notHere).arg(all);
}

bool isSamePicture(const ReferencedPicture& a, const ReferencedPicture& b) {
  return a.sopInstanceUid == b.sopInstanceUid && a.frames == b.frames;
}

void addOnce(std::vector<ReferencedPicture>& all, const std::vector<ReferencedPicture>& pictures) {
  for (const ReferencedPicture& picture : pictures)
    if (std::ranges::none_of(all, [&](const auto& known) { return isSamePicture(known, picture); }))
      all.push_back(picture);
}

QString escaped(const std::string& text) { return shownText(text).toHtmlEscaped(); }

/// Writes the measurement groups of a report.
class ReportWriter {
 public:
  ReportWriter(const Report& report, const std::vector<bool>& isHere)
      : pictures_(reportPictures(report)), isHere_(isHere) {}

  QString group(const MeasurementGroup& group) const {
    QStringList head;
    for (const std::string& text : {group.finding.meaning, group.site.meaning, group.category.meaning})
      if (!text.empty()) head << escaped(text);
    const QString name = group.trackingId.empty() ? tr("Measurement group") : escaped(group.trackingId);
    QString html = QStringLiteral("<h4>%1</h4>").arg(name);
    if (!head.isEmpty()) html += QStringLiteral("<p>%1</p>").arg(head.join(QStringLiteral(", ")));
    QString rows;
    for (const ReportMeasurement& m : group.measurements) rows += measurement(m);
    for (const ReportProperty& p : group.evaluations)
      rows += row(escaped(p.name.meaning), escaped(p.value.meaning));
    if (!rows.isEmpty()) html += QStringLiteral("<table cellpadding=\"2\">%1</table>").arg(rows);
    return html + places(group);
  }

 private:
  static QString row(const QString& name, const QString& value) {
    return QStringLiteral("<tr><td>%1</td><td><b>%2</b></td></tr>").arg(name, value);
  }

  static QString measurement(const ReportMeasurement& m) {
    const std::string unit = m.unit.value == "1" ? std::string() : m.unit.value;
    const QString value =
        m.value ? QStringLiteral("%1 %2").arg(*m.value, 0, 'g', 8).arg(unitText(unit)) : tr("not given");
    QStringList more;
    for (const ReportProperty& p : m.properties) more << escaped(p.value.meaning);
    more.removeAll(QString());
    const QString name = escaped(m.name.meaning);
    return row(more.isEmpty() ? name : QStringLiteral("%1 (%2)").arg(name, more.join(QStringLiteral(", "))),
               value.trimmed());
  }

  static QString unitText(const std::string& ucum) {
    if (ucum == "[hnsf'U]") return QStringLiteral("HU");
    QString text = escaped(ucum);
    for (const auto& [plain, raised] :
         {std::pair("mm2", "mm\u00b2"), {"cm2", "cm\u00b2"}, {"mm3", "mm\u00b3"}})
      if (text == QLatin1String(plain)) return QString::fromUtf8(raised);
    return text;
  }

  QString places(const MeasurementGroup& group) const {
    QString html;
    std::vector<ReferencedPicture> all;
    const auto add = [&](const std::vector<ReportShape>& shapes) {
      for (const ReportShape& shape : shapes) {
        html += shapeText(shape);
        addOnce(all, shape.pictures);
      }
    };
    add(group.shapes);
    for (const ReportMeasurement& m : group.measurements) add(m.shapes);
    addOnce(all, group.pictures);
    for (const ReferencedPicture& picture : all) html += pictureText(picture);
    return html;
  }

  static QString shapeText(const ReportShape& shape) {
    const QString type = QLatin1String(typeName(shape.type));
    if (!shape.inPatient || shape.points.size() != 1)
      return QStringLiteral("<p>%1</p>")
          .arg(shape.inPatient ? tr("In the patient: %1").arg(type) : tr("In the picture: %1").arg(type));
    const glm::dvec3 p = shape.points.front();
    return QStringLiteral("<p>%1</p>")
        .arg(tr("In the patient: %1 at %2, %3, %4 mm (L, P, S)")
                 .arg(type)
                 .arg(p.x, 0, 'f', 1)
                 .arg(p.y, 0, 'f', 1)
                 .arg(p.z, 0, 'f', 1));
  }

  QString pictureText(const ReferencedPicture& picture) const {
    const auto found =
        std::ranges::find_if(pictures_, [&](const auto& known) { return isSamePicture(known, picture); });
    const auto n = std::size_t(found - pictures_.begin());
    if (n >= isHere_.size() || !isHere_[n])
      return QStringLiteral("<p>%1</p>").arg(tr("An object that it refers to is not here."));
    return QStringLiteral("<p><a href=\"picture:%1\">%2</a></p>").arg(n).arg(tr("Go to picture"));
  }

  const std::vector<ReferencedPicture> pictures_;
  const std::vector<bool>& isHere_;
};

}  // namespace

QString derivedName(const DerivedObject& object) {
  const QString label = shownText(object.label);
  return label.isEmpty() ? kindNameOf(object.kind)
                         : QStringLiteral("%1: %2").arg(kindNameOf(object.kind), label);
}

QString aloneText(const DerivedObject& object) {
  const auto with = [&](const QString& what) {
    return tr("%1: %2. Open the pictures that it is for, then click it in the list of studies.")
        .arg(derivedName(object), what);
  };
  switch (object.kind) {
    case DerivedKind::presentation:
      return with(tr("it says how pictures are to be shown"));
    case DerivedKind::keyObjects:
      return with(tr("they mark pictures"));
    case DerivedKind::report:
      return with(tr("it is text about pictures"));
    case DerivedKind::contours:
      return with(tr("outlines of regions over slices"));
    case DerivedKind::segmentation:
      return with(tr("regions that tint slices"));
  }
  return {};
}

QStringList referenceLines(const DerivedObject& object, std::size_t notHere) {
  QStringList details{object.date.empty() ? QString() : dateText(object.date),
                      notHereText(notHere, object.pictures.size())};
  details.removeAll(QString());
  QStringList lines{derivedName(object)};
  if (!details.isEmpty()) lines << details.join(QStringLiteral(", "));
  return lines;
}

std::vector<ReferencedPicture> reportPictures(const Report& report) {
  std::vector<ReferencedPicture> all;
  const auto add = [&](const std::vector<ReportShape>& shapes) {
    for (const ReportShape& shape : shapes) addOnce(all, shape.pictures);
  };
  for (const MeasurementGroup& group : report.groups) {
    add(group.shapes);
    for (const ReportMeasurement& m : group.measurements) add(m.shapes);
    addOnce(all, group.pictures);
  }
  return all;
}

QString reportHtml(const DerivedObject& object, const Report& report, const std::vector<bool>& isHere) {
  const ReportWriter writer(report, isHere);
  const QString title =
      report.title.meaning.empty() ? shownText(object.label) : shownText(report.title.meaning);
  QString html = QStringLiteral("<h3>%1</h3>").arg(title.toHtmlEscaped());
  if (!object.date.empty()) html += QStringLiteral("<p>%1</p>").arg(dateText(object.date).toHtmlEscaped());
  for (const MeasurementGroup& group : report.groups) html += writer.group(group);
  if (report.groups.empty())
    html += QStringLiteral("<p>%1</p>").arg(tr("This report holds no measurements that can be shown."));
  for (const std::string& warning : report.warnings)
    html += QStringLiteral("<p><i>%1</i></p>").arg(escaped(warning));
  return html;
}

}  // namespace volumen
