#include "ui/panels/segment_steps_page.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>

#include "results/text/text.h"
#include "ui/controller/segment_target.h"
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
      kinds_(new QComboBox),
      fields_(new StepFields(editing.session())),
      apply_(new QPushButton(tr("Apply"))) {
  kinds_->setObjectName(QStringLiteral("segmentStepKind"));
  kinds_->setAccessibleName(tr("Step on the current segment"));
  apply_->setObjectName(QStringLiteral("segmentApply"));
  fillKinds();
  for (const char* name : usualSteps) {
    auto* button = new QToolButton;
    button->setSizePolicy(QSizePolicy::MinimumExpanding, QSizePolicy::Fixed);
    button->setObjectName(QStringLiteral("segmentStep-") + QLatin1String(name));
    usual_.push_back({&offeredStep(name), button});
    connect(button, &QToolButton::clicked, this, [this, kind = usual_.back().kind] { apply(*kind); });
  }
  makeLayout();
  connect(kinds_, &QComboBox::currentIndexChanged, this, &SegmentStepsPage::showSegments);
  connect(apply_, &QPushButton::clicked, this, [this] { apply(chosen()); });
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

void SegmentStepsPage::makeLayout() {
  auto* grid = new QGridLayout;
  grid->setSpacing(2);
  constexpr int columns = 3;
  for (int n = 0; n < int(usual_.size()); ++n)
    grid->addWidget(usual_[std::size_t(n)].button, n / columns, n % columns);
  auto* any = new QHBoxLayout;
  any->setSpacing(4);
  any->addWidget(kinds_, 1);
  any->addWidget(apply_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addLayout(grid);
  column->addLayout(any);
  column->addWidget(fields_);
  column->addStretch();
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
