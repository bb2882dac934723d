#pragma once

#include <QFrame>

#include "emca/client/connection.h"

class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace emca::explorer {

class Theme;

/// Drops down from the toolbar: address, token, and the renderers that were connected before. It goes when one clicks
/// elsewhere, so it is in nobody's way.
class ConnectPanel : public QFrame {
    Q_OBJECT
  public:
    static constexpr int kRemembered = 8;

    explicit ConnectPanel(Theme& theme, QWidget* parent = nullptr);

    /// Newest first, as Address::text().
    const QStringList& history() const { return history_; }
    void setHistory(const QStringList& history);
    /// Moves an address to the front.
    void remember(const client::Address& address);
    void showError(const QString& sentence);
    /// Below a widget of the toolbar.
    void openBelow(QWidget* anchor);

  signals:
    void connectWanted(emca::client::Address address, QString token);

  private:
    void submit();
    QLineEdit* address_;
    QLineEdit* token_;
    QLabel* error_;
    QListWidget* list_;
    QPushButton* button_;
    QStringList history_;
};

}  // namespace emca::explorer
