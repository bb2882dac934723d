#pragma once

#include <QTimer>
#include <QWidget>

namespace emca::explorer {

class Theme;

/// A small window of another process, while the explorer cannot show anything itself: which plugin keeps it from
/// answering, and a button that ends the explorer. Goes by itself when the explorer answers again or has ended.
class BlockedNotice : public QWidget {
    Q_OBJECT
  public:
    /// \param mark  file that exists as long as the plugin blocks  \param process  the explorer's
    BlockedNotice(Theme& theme, const QString& plugin, const QString& mark, qint64 process);

  signals:
    void over();

  private:
    QString mark_;
    qint64 process_;
    QTimer timer_;
};

/// Whether a process of that number lives.
bool isAlive(qint64 process);

}  // namespace emca::explorer
