#include "ui/widgets/start_page.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace volumen {

StartPage::StartPage(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("startPage"));
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::Base);
  auto* title = new QLabel(QStringLiteral("volumen"));
  QFont large = title->font();
  large.setPointSizeF(large.pointSizeF() * 2);
  title->setFont(large);
  auto* hint = new QLabel(tr("or drop a folder or files onto this window"));
  auto* notice = new QLabel(tr("Not for clinical use."));
  auto* column = new QVBoxLayout(this);
  column->addStretch(2);
  column->addWidget(title, 0, Qt::AlignHCenter);
  column->addSpacing(16);
  const auto button = [&](const QString& name, const QString& text, void (StartPage::*signal)()) {
    auto* made = new QPushButton(text);
    made->setObjectName(name);
    made->setMinimumSize(340, 40);
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
  column->addStretch(3);
  column->addWidget(notice, 0, Qt::AlignHCenter);
}

}  // namespace volumen
