#include "ui/panels/segment_steps_page.h"

#include <QGridLayout>

#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

// Steps with a button, three in a row.
constexpr const char* usualSteps[] = {"fill",     "invert", "largest", "grow",   "shrink",
                                      "gaussian", "close",  "open",    "islands"};

// Returns the button text with the step's length, if any, such as "Grow 3 mm".
QString usualText(const StepKind& kind, const std::map<std::string, StepValue>& values) {
  const QString title = SegmentStepsPage::tr(kind.title);
  for (const StepField& field : kind.fields)
    if (const auto* number = std::get_if<double>(&values.at(field.name));
        number && std::string_view(field.unit) == "mm")
      return QStringLiteral("%1 %2 mm").arg(title).arg(*number);
  return title;
}

}  // namespace

SegmentStepsPage::SegmentStepsPage(SegmentEditing& editing, QWidget* parent)
    : QWidget(parent),
      editing_(editing),
      kinds_(choiceField({QStringLiteral("segmentStepKind"), tr("Step on the current segment")})),
      fields_(new StepFields(editing.session())),
      apply_(
          buttonOf<QPushButton>(QStringLiteral("segmentApply"), tr("Apply"), [this] { apply(chosen()); })) {
  fillKinds();
  auto* grid = new QGridLayout;
  grid->setSpacing(2);
  constexpr int columns = 3;
  for (const char* name : usualSteps) {
    const StepKind& kind = offeredStep(name);
    auto* button =
        buttonOf(QStringLiteral("segmentStep-") + QLatin1String(name), {}, [this, &kind] { apply(kind); });
    button->setSizePolicy(QSizePolicy::MinimumExpanding, QSizePolicy::Fixed);
    const int n = int(usual_.size());
    grid->addWidget(button, n / columns, n % columns);
    usual_.push_back({&kind, button});
  }
  stack(this, {grid, lineOf({{kinds_, 1}, apply_}), fields_, {}});
  connect(kinds_, &QComboBox::currentIndexChanged, this, &SegmentStepsPage::showSegments);
  connect(fields_, &StepFields::changed, this, &SegmentStepsPage::showWhatCanBeDone);
  connect(&editing_.session(), &Session::preferencesChanged, this,
          &SegmentStepsPage::showSegments);  // to update units
  showSegments();
}

// Lists steps that make a segment anew last.
void SegmentStepsPage::fillKinds() {
  bool isMaking = false;
  for (const StepKind& kind : offeredSteps()) {
    const bool makes = kind.use == StepKind::Use::makes;
    if (makes && !isMaking) kinds_->insertSeparator(kinds_->count());
    isMaking = makes;
    kinds_->addItem(tr(kind.title), QLatin1String(kind.name));
    kinds_->setItemData(kinds_->count() - 1, toolTipOf(tr("The segment becomes: %1.").arg(tr(kind.says))),
                        Qt::ToolTipRole);
  }
}

const StepKind& SegmentStepsPage::chosen() const {
  return offeredStep(kinds_->currentData().toString().toStdString());
}

void SegmentStepsPage::showSegments() {
  fields_->showKind(chosen());
  showWhatCanBeDone();
}

void SegmentStepsPage::showWhatCanBeDone() {
  const auto show = [this](QAbstractButton* button, const StepKind& kind) {
    const QString why = fields_->whyNot(kind);
    button->setEnabled(why.isEmpty());
    button->setToolTip(toolTipOf(QStringList{tr("The segment becomes: %1.").arg(tr(kind.says)), why}));
  };
  show(apply_, chosen());
  for (const UsualStep& usual : usual_) {
    show(usual.button, *usual.kind);
    usual.button->setText(usualText(*usual.kind, fields_->valuesFor(*usual.kind)));
  }
}

// Selects the kind, so that the fields show the values used.
void SegmentStepsPage::apply(const StepKind& kind) {
  kinds_->setCurrentIndex(kinds_->findData(QLatin1String(kind.name)));
  editing_.change(workOf(kind, fields_->valuesFor(kind), editing_.session()));
}

}  // namespace volumen
