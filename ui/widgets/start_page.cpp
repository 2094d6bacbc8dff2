#include "ui/widgets/start_page.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {
constexpr int buttonWidth = 340, mostRecent = 5;
}

StartPage::StartPage(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("startPage"));
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::Base);
  auto* title = plainLabel(QStringLiteral("volumen"));
  QFont large = title->font();
  large.setPointSizeF(large.pointSizeF() * 2);
  title->setFont(large);
  auto* hint = plainLabel(tr("or drop a folder or files onto this window"));
  auto* notice = plainLabel(tr("Not for clinical use."));
  auto* column = new QVBoxLayout(this);
  column->addStretch(2);
  column->addWidget(title, 0, Qt::AlignHCenter);
  column->addSpacing(16);
  const auto button = [&](const QString& name, const QString& text, void (StartPage::*signal)()) {
    auto* made = new QPushButton(text);
    made->setObjectName(name);
    made->setMinimumSize(buttonWidth, 40);
    connect(made, &QPushButton::clicked, this, signal);
    column->addWidget(made, 0, Qt::AlignHCenter);
  };
  button(QStringLiteral("startOpenFolder"), tr("Open a folder of DICOM files..."),
         &StartPage::openFolderRequested);
  button(QStringLiteral("startOpenFile"), tr("Open a file (DICOM, NRRD, NIfTI, MetaImage)..."),
         &StartPage::openFileRequested);
  button(QStringLiteral("startSample"), tr("Show the sample study"), &StartPage::sampleRequested);
  column->addSpacing(8);
  column->addWidget(hint, 0, Qt::AlignHCenter);
  recent_ = new QWidget;
  recentColumn_ = new QVBoxLayout(recent_);
  recentColumn_->setContentsMargins(0, 12, 0, 0);
  recentColumn_->setSpacing(0);
  recent_->hide();
  column->addWidget(recent_, 0, Qt::AlignHCenter);
  column->addStretch(3);
  column->addWidget(notice, 0, Qt::AlignHCenter);
}

void StartPage::showRecent(const QStringList& paths, const QSet<QString>& gone) {
  while (QLayoutItem* item = recentColumn_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  recent_->setVisible(!paths.isEmpty());
  if (paths.isEmpty()) return;
  recentColumn_->addWidget(plainLabel(tr("Opened last")), 0, Qt::AlignHCenter);
  for (const QString& path : paths.mid(0, mostRecent)) addRecent(path, gone.contains(path));
  auto* clear = new QPushButton(tr("Clear list"));
  clear->setObjectName(QStringLiteral("clearRecent"));
  clear->setFlat(true);
  connect(clear, &QPushButton::clicked, this, &StartPage::clearRecentRequested);
  recentColumn_->addWidget(clear, 0, Qt::AlignHCenter);
}

void StartPage::addRecent(const QString& path, bool gone) {
  auto* button = new QPushButton;
  button->setObjectName(QStringLiteral("recent"));
  button->setFlat(true);
  button->setFixedWidth(buttonWidth);
  const QString text = gone ? tr("%1 (not there)").arg(path) : path;
  button->setText(fontMetrics().elidedText(text, Qt::ElideMiddle, buttonWidth - 24));
  button->setAccessibleName(text);
  button->setToolTip(toolTipOf(path));
  button->setEnabled(!gone);
  connect(
      button, &QPushButton::clicked, this, [this, path] { Q_EMIT recentRequested(path); },
      Qt::QueuedConnection);  // the slot may rebuild the list with this button
  recentColumn_->addWidget(button);
}

}  // namespace volumen
