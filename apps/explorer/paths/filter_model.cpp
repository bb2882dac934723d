#include "paths/filter_model.h"

#include <QMetaObject>
#include <QRunnable>
#include <utility>

namespace emca::explorer {

FilterModel::FilterModel(QObject* parent) : QObject(parent), cancelled_(std::make_shared<std::atomic<bool>>(false)) {
    pool_.setMaxThreadCount(1);
}

FilterModel::~FilterModel() {
    *cancelled_ = true;
    pool_.waitForDone();
}

void FilterModel::setPaths(const PathSet& paths) {
    paths_ = paths;
    ask();
}

void FilterModel::setQuery(std::string query) {
    query_ = std::move(query);
    ask();
}

FilterModel::Answer FilterModel::answer(const query::Query& query, const PathSet& paths, const std::atomic<bool>& cancelled) {
    query::EvaluationLimits limits;
    limits.cancelled = [&cancelled] { return cancelled.load(std::memory_order_relaxed); };
    Answer out;
    auto matches = query.select(paths, limits, &out.error);
    if (matches) {
        out.matches = std::move(*matches);
    } else {
        out.failed = true;
        out.cancelled = matches.error().code == ErrorCode::cancelled;
        if (out.error.message.empty()) out.error.message = matches.error().message;
    }
    return out;
}

void FilterModel::ask() {
    *cancelled_ = true;
    cancelled_ = std::make_shared<std::atomic<bool>>(false);
    const std::uint64_t question = ++question_;
    if (query_.find_first_not_of(" \t\r\n") == std::string::npos) {
        state_ = State::empty;
        matches_ = {};
        error_ = {};
        emit changed();
        return;
    }
    query::QueryError error;
    auto query = query::Query::parse(query_, &error);
    if (!query) return fail(error);
    if (paths_.vertexCount() <= kAtOnce && paths_.pathCount() <= kAtOnce) return take(answer(*query, paths_, *cancelled_));
    state_ = State::running;
    error_ = {};
    emit changed();
    pool_.start(QRunnable::create([this, question, query = *query, paths = paths_, cancelled = cancelled_] {
        auto result = std::make_shared<Answer>(answer(query, paths, *cancelled));
        QMetaObject::invokeMethod(
            this, [this, question, result] { if (question == question_) take(std::move(*result)); }, Qt::QueuedConnection);
    }));
}

void FilterModel::take(Answer answer) {
    if (answer.failed) return fail(std::move(answer.error));
    state_ = State::done;
    matches_ = std::move(answer.matches);
    error_ = {};
    emit changed();
}

void FilterModel::fail(query::QueryError error) {
    state_ = State::failed;
    matches_ = {};
    error_ = std::move(error);
    emit changed();
}

}  // namespace emca::explorer
