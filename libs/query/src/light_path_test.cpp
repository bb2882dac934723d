#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <set>

#include "light_path.h"
#include "query_for_tests.h"

namespace emca::query {
namespace {

struct Scattering {
    Event event = Event::reflect;
    Lobe lobe = Lobe::diffuse;
    std::string label;
};

/// "RD", "TS'glass'" or "-" for a vertex without event.
std::optional<Scattering> scattering(const std::string& text) {
    if (text == "-") return std::nullopt;
    const std::string events = " RTV", lobes = " DGSs";
    Scattering out{static_cast<Event>(events.find(text[0])), static_cast<Lobe>(text[1] == '.' ? 0 : lobes.find(text[1])), {}};
    if (text.size() > 2) out.label = text.substr(3, text.size() - 4);
    return out;
}

/// A path that scatters as written and ends as `end` says: L connected to a light from the last vertex, O on a light,
/// B in the environment.
PathSet walk(const std::vector<std::string>& events, char end) {
    return recorded([&](Recording& r) {
        const auto p = r.path({0, 0}, 0);
        int depth = 0;
        for (const std::string& text : events) {
            const auto v = p.vertex(++depth);
            v.position(Vec3f{});
            if (const auto s = scattering(text)) v.event(s->event, s->lobe, s->label);
        }
        if (end == 'L') p.vertex(depth).contribution(Color(1), "light sampling", 1.f, LightEnd::connected);
        if (end == 'O') p.vertex(depth + 1).position(Vec3f{}).event(Event::emission).emission(Color(1)).contribution(Color(1), "hit", 1.f, LightEnd::hit);
        if (end == 'B') p.vertex(depth + 1).environment(Vec3f{}).event(Event::background).contribution(Color(1), "hit", 1.f, LightEnd::hit);
    });
}

std::string matches(const std::string& expression, const PathSet& paths) { return truths("lpe(" + quotedText(expression) + ")", paths); }

TEST(LightPath, ExpressionsOfTheFieldOnPathsByHand) {
    struct Row { const char* expression; std::vector<std::string> events; char end; const char* expected; };
    const std::vector<Row> rows{
        // Direct light, indirect light, as in OSL's examples.
        {"C<RD>L", {"RD"}, 'L', "1"}, {"C<RD>L", {"RD"}, 'O', "1"}, {"C<RD>L", {"RD"}, 'B', "1"}, {"C<RD>L", {"RD", "RD"}, 'L', "0"},
        {"C<RD>.*L", {"RD", "TS", "RG"}, 'L', "1"}, {"C<RD>.*L", {"RG", "RD"}, 'L', "0"}, {"C<RD>.*L", {"TD"}, 'L', "0"},
        {"CD+L", {"RD", "TD", "VD"}, 'L', "1"}, {"CD+L", {"RD", "RS"}, 'L', "0"}, {"CD+L", {}, 'O', "0"},
        {"C<.D>+L", {"RD", "TD", "VD"}, 'L', "1"}, {"CL", {}, 'O', "1"}, {"CO", {}, 'O', "1"}, {"CB", {}, 'O', "0"}, {"CB", {}, 'B', "1"},
        // Caustics: diffuse, then specular, then light; each end by itself.
        {"C D S+ L", {"RD", "TS", "TS"}, 'O', "1"}, {"CDS+L", {"RD", "TS", "RD"}, 'O', "0"}, {"CDS+O", {"RD", "TS"}, 'O', "1"}, {"CDS+B", {"RD", "TS"}, 'O', "0"}, {"CDS+B", {"RD", "RS"}, 'B', "1"},
        {"CDO", {"RD"}, 'L', "0"}, {"CDB", {"RD"}, 'L', "0"},
        // Sets, what is not in them, alternatives, repetitions.
        {"C[^S]*L", {"RD", "RG", "TD"}, 'L', "1"}, {"C[^S]*L", {"RD", "RS"}, 'L', "0"}, {"C[DG]*L", {"RD", "RG"}, 'L', "1"}, {"C[DG]*L", {"RD", "Rs"}, 'L', "0"},
        {"C(D|G)L", {"RG"}, 'L', "1"}, {"C(D|G)L", {"RS"}, 'L', "0"}, {"C(DS|SD)+L", {"RD", "RS", "TS", "TD"}, 'L', "1"}, {"C(D|)L", {}, 'O', "1"},
        {"CD{2}L", {"RD", "RD"}, 'L', "1"}, {"CD{2}L", {"RD"}, 'L', "0"}, {"CD{2,}L", {"RD", "RD", "RD"}, 'L', "1"}, {"CD{0,1}L", {"RD", "RD"}, 'L', "0"}, {"CDS?L", {"RD"}, 'L', "1"},
        {"C<[RT]S>*L", {"RS", "TS"}, 'O', "1"}, {"C<R[^DG]>L", {"RS"}, 'L', "1"}, {"C<R[^DG]>L", {"RG"}, 'L', "0"}, {"C[<RD><TS>]+L", {"TS", "RD"}, 'L', "1"}, {"C[<RD><TS>]+L", {"TD"}, 'L', "0"},
        {"C[^<RD>]L", {"RD"}, 'L', "0"}, {"C[^<RD>]L", {"TD"}, 'L', "1"}, {"C[D L]", {}, 'O', "1"},
        // Events and lobes alone.
        {"CRL", {"RG"}, 'L', "1"}, {"CTL", {"RG"}, 'L', "0"}, {"CVL", {"VG"}, 'L', "1"}, {"CsL", {"Ts"}, 'L', "1"}, {"CSL", {"Ts"}, 'L', "0"}, {"C.L", {"R."}, 'L', "1"}, {"CDL", {"R."}, 'L', "0"},
        // Labels.
        {"C<.S'glass'>+.*L", {"TS'glass'", "TS'glass'", "RD"}, 'L', "1"}, {"C<.S'glass'>+.*L", {"TS'ice'", "RD"}, 'L', "0"}, {"C<TS'glass'>L", {"RS'glass'"}, 'L', "0"},
        {"C<..'glass'>L", {"RG'glass'"}, 'L', "1"}, {"C[^<..'glass'>]L", {"RG'glass'"}, 'L', "0"}, {"C[^<..'glass'>]L", {"RG'wood'"}, 'L', "1"}, {"C<T'rough glass'>L", {"TG'rough glass'"}, 'L', "1"},
        // Blanks mean nothing.
        {" C < R D > . * L ", {"RD", "RG"}, 'L', "1"}, {"C [ ^ S ] L", {"RD"}, 'L', "1"}, {"C D { 1 , 2 } L", {"RD", "RD"}, 'L', "1"},
        // The whole way has to match, from the camera to the light.
        {"D", {"RD"}, 'L', "0"}, {"CD", {"RD"}, 'L', "0"}, {".*", {"RD"}, 'L', "0"}, {"C.*", {"RD"}, 'L', "1"}, {"CDL", {"RD"}, ' ', "0"}, {"", {}, 'O', "0"},
        // What was not recorded.
        {"C.*L", {"RD", "-"}, 'L', "?"}, {"CDL", {"-"}, 'L', "?"}, {"CDL", {"-"}, 'O', "?"},
    };
    for (const Row& row : rows) {
        // A second path with contributions, so that the first one is never taken for one of a renderer that records none.
        const PathSet sets[] = {walk(row.events, row.end), recorded([](Recording& r) { r.path({9, 9}, 0).vertex(1).event(Event::reflect, Lobe::straight).contribution(Color(1), "x", 1.f, LightEnd::connected); })};
        EXPECT_EQ(matches(row.expression, PathSet::merged(sets)).substr(0, 1), row.expected) << row.expression << " on " << ::testing::PrintToString(row.events) << row.end;
    }
}

TEST(LightPath, AnyContributionDecides) {
    const PathSet paths = recorded([](Recording& r) {
        const auto p = r.path({0, 0}, 0);
        p.vertex(1).position(Vec3f{}).event(Event::reflect, Lobe::diffuse).contribution(Color(1), "light", 1.f, LightEnd::connected);
        p.vertex(2).position(Vec3f{}).event(Event::transmit, Lobe::specular);
        p.vertex(3).position(Vec3f{}).emission(Color(1)).contribution(Color(1), "hit");
        r.path({0, 0}, 1).vertex(1).event(Event::reflect, Lobe::diffuse).contribution(Color(1), "automatic: no emission, so connected");
        r.path({0, 0}, 2).vertex(1).environment(Vec3f{}).contribution(Color(1), "automatic: environment");
        r.path({0, 0}, 3).vertex(1).event(Event::pass, Lobe::straight).contribution(Color(1), "through a mask", 1.f, LightEnd::connected);
        r.path({0, 0}, 4).vertex(0).position(Vec3f{});
    });
    EXPECT_EQ(matches("CDL", paths), "11000");
    EXPECT_EQ(matches("CDSO", paths), "10000");
    EXPECT_EQ(matches("CDSL", paths), "10000");
    EXPECT_EQ(matches("CDSB", paths), "00000");
    EXPECT_EQ(matches("CB", paths), "00100");
    EXPECT_EQ(matches("C<Ts>L", paths), "00010");
    EXPECT_EQ(matches("CD.{2,}L", paths), "00000");
    EXPECT_EQ(truths("lpe('CDL') and not lpe('CDSL') or lpe('CB')", paths), "01100");
    EXPECT_EQ(truths("any(v.depth == 1 and lpe('CDL'))", paths), "11000");
}

TEST(LightPath, WithoutContributionsTheWalkIsRead) {
    const PathSet paths = recorded([](Recording& r) {
        const auto p = r.path({0, 0}, 0);
        p.vertex(0).position(Vec3f{});  // the camera itself
        p.vertex(1).position(Vec3f{}).event(Event::reflect, Lobe::diffuse).nextEvent(Vec3f{}, false);
        p.vertex(2).position(Vec3f{}).event(Event::reflect, Lobe::glossy).nextEvent(Vec3f{}, true);
        p.vertex(3).position(Vec3f{}).event(Event::emission);
        r.path({0, 0}, 1).vertex(1).environment(Vec3f{});
        r.path({0, 0}, 2).vertex(1).event(Event::absorb);
    });
    EXPECT_EQ(matches("CDL", paths), "000");
    EXPECT_EQ(matches("CDGL", paths), "100") << "the light that was hit; shadow tests are no part of the walk";
    EXPECT_EQ(matches("CDGO", paths), "100");
    EXPECT_EQ(matches("CB", paths), "010");
}

TEST(LightPath, LightPathsAreSeenFromTheCamera) {
    const auto record = [](bool contributions) {
        return recorded([=](Recording& r) {
            const auto p = r.path({0, 0}, 0);
            p.vertex(0, Subpath::light).position(Vec3f{}).event(Event::emission);
            p.vertex(1, Subpath::light).position(Vec3f{}).event(Event::transmit, Lobe::specular);
            p.vertex(2, Subpath::light).position(Vec3f{}).event(Event::reflect, Lobe::diffuse);
            p.vertex(3, Subpath::light).position(Vec3f{}).event(Event::reflect, Lobe::glossy);
            if (contributions) p.vertex(2, Subpath::light).contribution(Color(1), "connection to the camera", 1.f, LightEnd::connected);
        });
    };
    // Vertex 2 was connected to the camera: from there on back to the light.
    EXPECT_EQ(matches("CDSL", record(true)), "1");
    EXPECT_EQ(matches("CGDSL", record(true)), "0");
    // Nothing says which vertex was: all of it.
    EXPECT_EQ(matches("CGDSL", record(false)), "1");
    EXPECT_EQ(matches("CDSL", record(false)), "0");
    // What lies between two subpaths was not recorded.
    const PathSet both = recorded([](Recording& r) {
        const auto p = r.path({0, 0}, 0);
        p.vertex(1).event(Event::reflect, Lobe::diffuse);
        p.vertex(1, Subpath::light).event(Event::reflect, Lobe::diffuse).contribution(Color(1), "bidirectional");
    });
    EXPECT_EQ(matches("C.*L", both), "?");
}

TEST(LightPath, LongWalksAreBounded) {
    const PathSet paths = recorded([](Recording& r) {
        const auto p = r.path({0, 0}, 0);
        for (int i = 1; i <= 6000; ++i) p.vertex(i).event(Event::volume, Lobe::glossy).contribution(Color(1), "light", 1.f, LightEnd::connected);
    });
    EXPECT_EQ(matches("CV{900}L", paths), "1");
    EXPECT_EQ(matches("CDL", paths), "?") << "what is longer than 4,096 events is not decided";
}

// Random expressions, by brute force: sets of places instead of an automaton.

struct Symbol {
    char kind = 'C';  // C, X (an event), L, O, B
    Scattering scattering;
};
using Word = std::vector<Symbol>;

struct Expression {
    std::string text;
    std::function<std::set<std::size_t>(const Word&, std::size_t)> ends;  ///< where a match may end that begins there
};

class RandomExpressions {
  public:
    explicit RandomExpressions(unsigned seed) : random_(seed) {}
    int upTo(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

    Expression whole() {
        const Expression rest = sequence(3);
        return upTo(8) == 0 ? rest : join(one({"C", [](const Symbol& s) { return s.kind == 'C'; }}), upTo(2) ? join(rest, one(letter("L"))) : rest);
    }
    Scattering scattering() { return {static_cast<Event>(1 + upTo(3)), static_cast<Lobe>(upTo(5)), upTo(2) ? "glass" : upTo(2) ? "wood" : ""}; }
    Word word() {
        Word out{{}};
        for (int n = upTo(5); n > 0; --n) out.push_back({'X', scattering()});
        out.push_back({"LOB"[upTo(3)], {}});
        return out;
    }

  private:
    struct Atom { std::string text; std::function<bool(const Symbol&)> fits; };

    Atom letter(const std::string& c) {
        if (c == ".") return {c, [](const Symbol& s) { return s.kind != 'C'; }};
        if (c == "L") return {c, [](const Symbol& s) { return s.kind == 'L' || s.kind == 'O' || s.kind == 'B'; }};
        if (c == "O" || c == "B" || c == "C") return {c, [c](const Symbol& s) { return s.kind == c[0]; }};
        const std::size_t event = std::string(" RTV").find(c), lobe = std::string(" DGSs").find(c);
        return {c, [=](const Symbol& s) {
            return s.kind == 'X' && (event != std::string::npos ? s.scattering.event == static_cast<Event>(event) : s.scattering.lobe == static_cast<Lobe>(lobe));
        }};
    }

    Atom event() {
        const std::string events = std::string("RTV.").substr(static_cast<std::size_t>(upTo(4)), 1), lobes = std::string("DGSs.").substr(static_cast<std::size_t>(upTo(5)), 1);
        const std::string label = upTo(3) ? "" : upTo(2) ? "glass" : "ice";
        const Atom first = letter(events), second = letter(lobes);
        return {"<" + events + lobes + (label.empty() ? "" : "'" + label + "'") + ">", [=](const Symbol& s) {
            return s.kind == 'X' && first.fits(s) && second.fits(s) && (label.empty() || s.scattering.label == label);
        }};
    }

    Atom atom() {
        if (upTo(3) == 0) return event();
        const std::string letters = "DDGGSsRTV..LOB";
        return letter(letters.substr(static_cast<std::size_t>(upTo(14)), 1));
    }

    static Expression one(const Atom& atom) {
        return {atom.text, [fits = atom.fits](const Word& w, std::size_t i) { return i < w.size() && fits(w[i]) ? std::set<std::size_t>{i + 1} : std::set<std::size_t>{}; }};
    }

    Expression setOf() {
        const bool others = upTo(2) == 0;
        std::vector<Atom> atoms;
        std::string text = others ? "[^" : "[";
        for (int n = upTo(3); n >= 0; --n) {
            atoms.push_back(atom());
            text += atoms.back().text + (upTo(4) ? "" : " ");
        }
        return one({text + "]", [=](const Symbol& s) { return s.kind != 'C' && others != std::any_of(atoms.begin(), atoms.end(), [&](const Atom& a) { return a.fits(s); }); }});
    }

    static std::set<std::size_t> then(const Expression& e, const Word& w, const std::set<std::size_t>& from) {
        std::set<std::size_t> out;
        for (const std::size_t i : from) out.merge(e.ends(w, i));
        return out;
    }
    static Expression join(const Expression& a, const Expression& b) {
        return {a.text + b.text, [=](const Word& w, std::size_t i) { return then(b, w, a.ends(w, i)); }};
    }
    static Expression either(const Expression& a, const Expression& b) {
        return {"(" + a.text + "|" + b.text + ")", [=](const Word& w, std::size_t i) {
            auto out = a.ends(w, i);
            out.merge(b.ends(w, i));
            return out;
        }};
    }
    static Expression times(const Expression& e, const std::string& sign, int least, int most) {
        return {e.text + sign, [=](const Word& w, std::size_t i) {
            std::set<std::size_t> now{i}, out;
            for (int n = 0; n <= most && !now.empty(); ++n) {
                if (n >= least) out.insert(now.begin(), now.end());
                now = then(e, w, now);
            }
            return out;
        }};
    }

    Expression piece(int depth) {
        Expression e = depth > 0 && upTo(4) == 0 ? either(sequence(depth - 1), sequence(depth - 1)) : upTo(4) == 0 ? setOf() : one(atom());
        switch (upTo(9)) {
            case 0: return times(e, "*", 0, 12);
            case 1: return times(e, "+", 1, 12);
            case 2: return times(e, "?", 0, 1);
            case 3: return times(e, "{2}", 2, 2);
            case 4: return times(e, "{1,3}", 1, 3);
            default: return e;
        }
    }
    Expression sequence(int depth) {
        Expression out = piece(depth);
        for (int n = upTo(3); n > 0; --n) out = join(out, piece(depth));
        return out;
    }

    std::mt19937 random_;
};

TEST(LightPath, RandomExpressionsAgreeWithBruteForce) {
    RandomExpressions random(3);
    int matched = 0, compared = 0;
    for (int i = 0; i < 3000; ++i) {
        const Expression e = random.whole();
        QueryError error;
        const auto expression = detail::LightPathExpression::parse(e.text, 0, error);
        ASSERT_TRUE(expression) << e.text << ": " << error.message;
        for (int n = 0; n < 20; ++n) {
            const Word word = random.word();
            std::string bytes;
            for (const Symbol& s : word) {
                const auto& labels = expression->labels();
                const auto label = std::find(labels.begin(), labels.end(), s.scattering.label);
                bytes += s.kind == 'C'   ? detail::LightPathExpression::kCamera
                         : s.kind == 'L' ? detail::LightPathExpression::kLight
                         : s.kind == 'O' ? detail::LightPathExpression::kSurface
                         : s.kind == 'B' ? detail::LightPathExpression::kEnvironment
                                         : expression->symbol(s.scattering.event, s.scattering.lobe, label == labels.end() ? 0 : static_cast<std::size_t>(label - labels.begin()) + 1);
            }
            const bool expected = e.ends(word, 0).count(word.size()) > 0;
            ASSERT_EQ(expression->matches(bytes), expected) << e.text << " on " << ::testing::PrintToString(bytes);
            matched += expected;
            ++compared;
        }
    }
    EXPECT_GT(matched, compared / 50);
    EXPECT_LT(matched, compared / 2);
}

/// The ways of a path that its contributions stand for; no value: it cannot be known.
std::vector<std::optional<Word>> waysOf(const PathSet& paths, Index p) {
    std::vector<std::optional<Word>> out;
    std::optional<Word> way{Word{{}}};
    for (Index v = paths.vertices(p).first; v < paths.vertices(p).last; ++v) {
        const auto s = paths.scattering(v);
        const auto emission = paths.emission(v);
        const bool camera = !s && paths.depthIndex(v) == 0;
        std::optional<Word> after = way;
        const bool scatters = s && (s->event == Event::reflect || s->event == Event::transmit || s->event == Event::volume);
        if (scatters && after) after->push_back({'X', {s->event, s->lobe, std::string(s->label)}});
        else if (!camera) after.reset();
        const IndexRange contributions = paths.contributions(v);
        for (Index i = contributions.first; i < contributions.last; ++i) {
            const LightEnd end = paths.contribution(i).end;
            const bool hit = end == LightEnd::hit || (end == LightEnd::automatic && (paths.isEnvironment(v) || (emission && !isBlack(*emission))));
            std::optional<Word> one = hit ? way : after;
            if (camera) one.reset();
            if (one) one->push_back({!hit ? 'L' : paths.isEnvironment(v) ? 'B' : 'O', {}});
            out.push_back(one);
        }
        way = after;
    }
    return out;
}

TEST(LightPath, RandomPathsAgreeWithBruteForce) {
    RandomExpressions random(5);
    std::array<int, 3> counts{};
    for (int i = 0; i < 150; ++i) {
        const PathSet paths = recorded([&](Recording& r) {
            for (int p = 0; p < 40; ++p) {
                const auto path = r.path({static_cast<std::uint32_t>(p / 20), 0}, p);
                path.finalEstimate(Color(1));
                const int first = random.upTo(2), count = random.upTo(6);
                for (int d = first; d < first + count; ++d) {
                    const auto v = path.vertex(d);
                    const Scattering s = random.scattering();
                    if (random.upTo(20) != 0 && d > 0) v.event(s.event, s.lobe, s.label);
                    if (d == first + count - 1 && random.upTo(3) == 0) v.environment(Vec3f{});
                    else v.position(Vec3f{});
                    if (random.upTo(4) == 0) v.emission(Color(static_cast<float>(random.upTo(2))));
                    for (int n = random.upTo(4) - 1; n > 0; --n) v.contribution(Color(1), "x", 1.f, static_cast<LightEnd>(random.upTo(3)));
                }
            }
        });
        for (int n = 0; n < 10; ++n) {
            const Expression e = random.whole();
            std::string expected;
            for (Index p = 0; p < paths.pathCount(); ++p) {
                bool yes = false, unknown = false;
                for (const auto& way : waysOf(paths, p)) {
                    if (way) yes |= e.ends(*way, 0).count(way->size()) > 0;
                    else unknown = true;
                }
                expected += yes ? '1' : unknown ? '?' : '0';
                ++counts[yes ? 0 : unknown ? 1 : 2];
            }
            ASSERT_EQ(matches(e.text, paths), expected) << e.text;
        }
    }
    for (const int count : counts) EXPECT_GT(count, 500);
}

}  // namespace
}  // namespace emca::query
