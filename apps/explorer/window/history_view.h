#pragma once

#include <QAbstractListModel>
#include <QWidget>
#include <memory>

#include "base/listeners.h"

class QListView;

namespace emca::explorer {

class StateOverlay;
class Theme;

/// The traced pixels and regions, newest first, with their colours as the image shows them.
class HistoryModel : public QAbstractListModel {
    Q_OBJECT
  public:
    explicit HistoryModel(client::Dataset& dataset, QObject* parent = nullptr);
    void reload();
    int rowCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    std::shared_ptr<const client::Trace> trace(int row) const;

    /// A trace as a row shows it; of a region: its mean and its worst verdict.
    struct Entry {
        std::shared_ptr<const client::Trace> trace;
        QString name;            ///< "(12, 34)" or "region 8x8 at (12, 34)"
        ReplayCounts counts;
        Replay replay;
    };
    /// \param row  in [0, rowCount())
    const Entry& entry(int row) const { return entries_[static_cast<std::size_t>(row)]; }

  private:
    static Entry entryOf(std::shared_ptr<const client::Trace> trace);
    client::Dataset& dataset_;
    std::vector<Entry> entries_;
};

/// Pixel history: a click shows that reply again without asking the renderer.
class HistoryView : public QWidget {
    Q_OBJECT
  public:
    HistoryView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
    QListView& list() { return *list_; }

  signals:
    void traceChosen(std::shared_ptr<const emca::client::Trace> trace);
    void traceAgainWanted();

  private:
    void reload();
    void follow();

    client::Dataset& dataset_;
    HistoryModel* model_;
    QListView* list_;
    StateOverlay* overlay_;
    DatasetListening datasetListening_;
};

}  // namespace emca::explorer
