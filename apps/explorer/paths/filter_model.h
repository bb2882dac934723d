#pragma once

#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "emca/core/path_set.h"
#include "emca/query/query.h"

namespace emca::explorer {

/// The answer to a query on the paths that are shown. Small sets are asked at once, large ones in another thread, whose
/// answer comes later; meanwhile the last one stays, and a newer question ends an older one. GUI thread.
class FilterModel : public QObject {
    Q_OBJECT
  public:
    enum class State {
        empty,    ///< no query
        failed,   ///< error() says why
        running,  ///< matches() are those of the last question
        done,
    };
    /// Sets up to this many vertices are asked in the GUI thread: a few milliseconds.
    static constexpr Index kAtOnce = 1u << 14;

    explicit FilterModel(QObject* parent = nullptr);
    ~FilterModel() override;

    void setPaths(const PathSet& paths);
    void setQuery(std::string query);

    State state() const { return state_; }
    const std::string& query() const { return query_; }
    const PathSet& paths() const { return paths_; }
    const query::Matches& matches() const { return matches_; }
    const query::QueryError& error() const { return error_; }

  signals:
    /// Any of the above.
    void changed();

  private:
    struct Answer {
        bool failed = false, cancelled = false;
        query::Matches matches;
        query::QueryError error;
    };
    static Answer answer(const query::Query& query, const PathSet& paths, const std::atomic<bool>& cancelled);
    void ask();
    void take(Answer answer);
    void fail(query::QueryError error);

    std::string query_;
    PathSet paths_;
    State state_ = State::empty;
    query::Matches matches_;
    query::QueryError error_;
    std::uint64_t question_ = 0;
    std::shared_ptr<std::atomic<bool>> cancelled_;
    QThreadPool pool_;
};

}  // namespace emca::explorer
