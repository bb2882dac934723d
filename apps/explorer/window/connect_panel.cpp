#include "window/connect_panel.h"

#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>

#include "base/qt_compat.h"
#include "base/theme.h"

namespace emca::explorer {

ConnectPanel::ConnectPanel(Theme& theme, QWidget* parent)
    : QFrame(parent, Qt::Popup), address_(new QLineEdit), token_(new QLineEdit), error_(new QLabel), list_(new QListWidget),
      button_(new QPushButton(tr("Connect"))) {
    setObjectName("connectPanel");
    setStyleSheet("#connectPanel { border: 1px solid palette(mid); }");
    setFixedWidth(340);
    address_->setObjectName("address");
    address_->setPlaceholderText(tr("host:port"));
    address_->setToolTip(tr("Where the renderer listens, such as 127.0.0.1:50013"));
    token_->setToolTip(tr("The word that the server was started with, if any"));
    button_->setToolTip(tr("Fetches scene, camera and image (Enter)"));
    list_->setToolTip(tr("Renderers of before; a click connects"));
    address_->setFont(theme.numberFont());
    token_->setPlaceholderText(tr("only if the server asks for one"));
    token_->setEchoMode(QLineEdit::Password);
    error_->setWordWrap(true);
    error_->setProperty("role", "muted");
    button_->setProperty("primary", true);
    button_->setDefault(true);
    auto* hint = new QLabel(tr("Start one with  emca-render scene.xml --serve 50013"));
    hint->setProperty("role", "muted");
    hint->setWordWrap(true);
    list_->setFont(theme.numberFont());
    list_->setMaximumHeight(132);

    auto* form = new QFormLayout;
    form->setSpacing(Spacing::small);
    form->addRow(tr("Renderer"), address_);
    form->addRow(tr("Token"), token_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::large, Spacing::large, Spacing::large, Spacing::large);
    layout->setSpacing(Spacing::small);
    layout->addLayout(form);
    layout->addWidget(error_);
    layout->addWidget(button_);
    layout->addWidget(list_);
    layout->addWidget(hint);
    error_->hide();
    setHistory({});

    connect(button_, &QPushButton::clicked, this, &ConnectPanel::submit);
    connect(address_, &QLineEdit::returnPressed, this, &ConnectPanel::submit);
    connect(token_, &QLineEdit::returnPressed, this, &ConnectPanel::submit);
    connect(list_, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) {
        address_->setText(item->text());
        submit();
    });
}

void ConnectPanel::setHistory(const QStringList& history) {
    history_ = history.mid(0, kRemembered);
    list_->clear();
    list_->addItems(history_);
    list_->setVisible(!history_.isEmpty());
    if (address_->text().isEmpty()) address_->setText(history_.isEmpty() ? toQString(client::Address().text()) : history_.front());
}

void ConnectPanel::remember(const client::Address& address) {
    QStringList history = history_;
    const QString text = toQString(address.text());
    history.removeAll(text);
    history.prepend(text);
    setHistory(history);
    address_->setText(text);
    error_->hide();
}

void ConnectPanel::showError(const QString& sentence) {
    error_->setText(sentence);
    error_->show();
}

void ConnectPanel::openBelow(QWidget* anchor) {
    error_->hide();
    adjustSize();
    move(anchor->mapToGlobal(QPoint(0, anchor->height() + 2)));
    show();
    address_->setFocus();
    address_->selectAll();
}

void ConnectPanel::submit() {
    const auto address = client::Address::parse(address_->text().trimmed().toStdString());
    if (!address) {
        showError(toQString(address.error().message));
        return;
    }
    hide();
    emit connectWanted(*address, token_->text());
}

}  // namespace emca::explorer
