#include "window/name_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>

#include "base/theme.h"

namespace emca::explorer {

NamePanel::NamePanel(QWidget* window) : QFrame(window, Qt::Popup), question_(new QLabel), name_(new QLineEdit), button_(new QPushButton) {
    setObjectName("namePanel");
    setStyleSheet("#namePanel { border: 1px solid palette(mid); }");
    setFixedWidth(360);
    name_->setObjectName("name");
    name_->setMaxLength(60);
    name_->setToolTip(tr("A name for the menu"));
    button_->setProperty("primary", true);
    auto* line = new QHBoxLayout;
    line->setSpacing(Spacing::small);
    line->addWidget(name_, 1);
    line->addWidget(button_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::large, Spacing::large, Spacing::large, Spacing::large);
    layout->setSpacing(Spacing::small);
    layout->addWidget(question_);
    layout->addLayout(line);
    connect(name_, &QLineEdit::textChanged, this, &NamePanel::update);
    connect(name_, &QLineEdit::returnPressed, this, &NamePanel::submit);
    connect(button_, &QPushButton::clicked, this, &NamePanel::submit);
}

void NamePanel::ask(const QString& question, const QString& suggestion, const QStringList& taken, std::function<void(const QString&)> named) {
    question_->setText(question);
    taken_ = taken;
    named_ = std::move(named);
    name_->setText(suggestion);
    update();
    adjustSize();
    const QWidget& window = *parentWidget();
    move(window.mapToGlobal(QPoint((window.width() - width()) / 2, window.height() / 6)));
    show();
    name_->setFocus();
    name_->selectAll();
}

void NamePanel::update() {
    const QString name = name_->text().simplified();
    button_->setEnabled(!name.isEmpty());
    button_->setText(taken_.contains(name, Qt::CaseInsensitive) ? tr("Replace") : tr("Save"));
    button_->setToolTip(name.isEmpty() ? tr("Type a name first") : tr("Save as “%1” (Enter)").arg(name));
}

void NamePanel::submit() {
    const QString name = name_->text().simplified();
    if (name.isEmpty()) return;
    hide();
    if (named_) named_(name);
}

}  // namespace emca::explorer
