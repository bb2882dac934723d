#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "assemble.h"
#include "assemble_surface.h"
#include "emca/client/session.h"
#include "emca/protocol/session.h"
#include "session_reader.h"

namespace emca::client {

/// Puts an opened session together from the blocks of its parts, in the order of the file. A part that is damaged or ends
/// early costs nothing but itself: of images and scenes stays what came.
class PartCollector {
  public:
    PartCollector(OpenedSession& opened, std::uint64_t maximumBytes) : opened_(opened), bytesLeft_(maximumBytes) {}

    void add(SessionReader::Block block);
    /// After the last block. \param endsAt  bytes of a file that ends too early
    void finish(std::optional<std::uint64_t> endsAt);

  private:
    struct ImageUnderWay {
        ImageEntry entry;
        RenderedImage image;
        std::vector<bool> rows[protocol::saved::kPlanes];   ///< which came
        bool current = false;
        std::uint32_t number = 0;                           ///< among the images of the file, from 1
    };
    struct TraceUnderWay {
        protocol::saved::Trace about;
        std::shared_ptr<const Trace> trace;
    };
    struct SceneUnderWay {
        SceneAssembler assembler;
        std::uint32_t announced = 0;
    };
    using UnderWay = std::variant<std::monostate, ImageUnderWay, TraceUnderWay, SceneUnderWay, SurfaceAssembler>;

    void take(protocol::Message message);
    void take(protocol::saved::Item item);
    void take(protocol::saved::Notes notes);
    void take(const protocol::saved::Selection& selection);
    void take(protocol::saved::Filter filter);
    void take(protocol::saved::View view);
    void take(const protocol::saved::Image& image);
    void take(const protocol::saved::Rows& rows);
    void take(protocol::TraceResult result);
    void take(const protocol::SceneChunk& chunk);

    void finishPart();
    void finishImage(ImageUnderWay& image);
    void finishTrace(TraceUnderWay& trace);
    void finishScene(SceneUnderWay& scene);
    void finishSurface(SurfaceAssembler& surface);
    void report(const std::string& sentence);
    void fault(const std::string& clause, bool later = false);
    std::string titleHere(const std::string& otherwise) const;
    std::string titleOf(std::size_t planned) const;
    std::uint32_t imageNumber();

    OpenedSession& opened_;
    std::uint64_t bytesLeft_;                      ///< of announced images
    std::optional<protocol::saved::Head> plan_;
    std::vector<bool> seen_;                       ///< of the plan
    std::optional<std::uint32_t> part_;            ///< the one under way
    UnderWay underWay_;
    bool faulty_ = false;                          ///< it has been complained of
    bool sceneIsWhole_ = false;
    std::uint32_t imageCount_ = 0;                 ///< that came without a plan
    std::uint32_t reference_ = 0;                  ///< number of the reference image, from 1; 0: none
    std::vector<std::string> missing_;
    std::vector<std::pair<std::uint32_t, std::size_t>> shown_;   ///< place and index of traces
};

}  // namespace emca::client
