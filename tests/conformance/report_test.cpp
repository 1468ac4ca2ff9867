// The page of clvndf check: what is wrong stands there, in numbers and in pictures, and what it says can be repeated.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <regex>

#include "conformance/judge/bsdf.h"
#include "conformance/report/cells.h"
#include "conformance/report/page.h"
#include "conformance/report/picture.h"
#include "conformance/runs/check.h"
#include "conformance/runs/user_check.h"
#include "gltf/decode.h"
#include "gltf/uri.h"
#include "support/command.h"
#include "support/skip.h"
#include "text.h"

using namespace vndf;
using namespace vndf::conformance;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr const char* sampler = "vndf_ggx_sample_wm_heitz2018";

// A quick check of the sampler, with alpha_x and alpha_y swapped after the stretch if `wrong`.
Report checked(bool wrong, Pictures pictures) {
    runtime::ProgramOptions program;
    program.functions = {sampler};
    if (wrong)
        program.substitutions = {{"kernels/vndf/impl/stretch.h",
                                  "VNDF_REAL gx = alpha_x * hx, gy = alpha_y * hy;",
                                  "VNDF_REAL gx = alpha_y * hx, gy = alpha_x * hy;", 1}};
    program.mutant = wrong;
    runtime::DeviceEvaluator evaluator(runtime::choose_device().device, runtime::Math::strict,
                                       runtime::Real::f32, program);
    CheckOptions options;
    options.quick = true, options.pictures = pictures;
    return check(evaluator, runtime::Math::strict, {find_function(sampler)}, options);
}

std::string page_of(const Report& report, bool all) {
    PageOptions options;
    options.software = "clvndf", options.all = all;
    options.evaluate = [](const Function& f) { return "clvndf eval " + f.name; };
    options.check = [](const Function& f) { return "clvndf check --only " + f.name; };
    return format_page(report, options);
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++found;
    return found;
}

// The first tag that another one closes, or that none does; empty if every one is closed where it should be.
std::string unbalanced(const std::string& html) {
    static const std::regex tag(R"(<(/?)(!?[a-z0-9]+)((?:'[^']*'|[^'>])*)>)");
    std::vector<std::string> open;
    for (std::sregex_iterator i(html.begin(), html.end(), tag), end; i != end; ++i) {
        const std::string name = (*i)[2], rest = (*i)[3];
        if (name == "!doctype" || name == "meta" || name == "br" || name == "wbr" || rest.ends_with('/'))
            continue;
        if ((*i)[1].length() == 0) {
            open.push_back(name);
        } else {
            if (open.empty() || open.back() != name) return (*i)[0];
            open.pop_back();
        }
    }
    return open.empty() ? "" : open.back();
}

}  // namespace

TEST_CASE("a run in pieces judges every lobe once, and says the same in whatever order they are judged") {
    const Function& function = *find_function(sampler);
    runtime::ProgramOptions program;
    program.functions = {sampler};
    runtime::DeviceEvaluator evaluator(runtime::choose_device().device, runtime::Math::strict,
                                       runtime::Real::f32, program);
    CheckOptions options;
    options.quick = true, options.pictures = Pictures::all;
    const auto text = [](Report report) {
        report.seconds = 0;
        return format_json(report) + page_of(report, true);
    };
    CheckRun run(runtime::Math::strict, runtime::Real::f32, {&function}, options);
    std::vector<std::string> judged(run.pieces());
    CHECK(judged.size() > 2);
    for (std::size_t i = judged.size(); i-- > 0;) judged[i] = run.judge(evaluator, i);
    for (const std::string& piece : judged) run.take(piece);
    const Report report = run.finish();
    CHECK(text(report) == text(check(evaluator, runtime::Math::strict, {&function}, options)));

    PointwiseOptions quick;
    quick.quick = true;
    const std::vector<Point> all = lobes(function, quick);
    const std::vector<LobePicture>& pictures = report.functions.front().pictures;
    REQUIRE(pictures.size() == all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        CHECK(pictures[i].row == tabulate(function, {all[i]}, runtime::Real::f32).row(0));
}

TEST_CASE("a wrong sampler's page shows what is wrong, and needs no other file") {
    const Report report = checked(true, Pictures::failed);
    const FunctionReport& judged = report.functions.front();
    // Swapped: wrong where the lobe is anisotropic, and nowhere else.
    REQUIRE_FALSE(judged.pictures.empty());
    for (const LobePicture& picture : judged.pictures) CHECK(picture.row[3] != picture.row[4]);
    const std::string page = page_of(report, false);
    CHECK(unbalanced(page) == "");
    CHECK(count(page, "<figure>") == judged.pictures.size());
    CHECK_THAT(page, ContainsSubstring("0 of 1 functions pass") && ContainsSubstring(report.device) &&
                         ContainsSubstring("FAIL chi2 of the directions") &&
                         ContainsSubstring("seed 1 (quick") &&
                         ContainsSubstring("less than once in 1,000,000"));
    for (const char* other : {"<script", "http:", "https:", "src=", "url(", "@import", "<link"}) {
        INFO(other);
        CHECK(page.find(other) == page.npos);
    }
    // Colours of both ends where too few and too many are.
    const LobePicture& first = judged.pictures.front();
    double least = 0, most = 0;
    for (std::size_t i = 0; i < first.directions.observed.size(); ++i) {
        const double sigma = deviations(first.directions.observed[i], first.directions.expected[i]);
        least = std::min(least, sigma), most = std::max(most, sigma);
    }
    CHECK((least < -7 && most > 7));
    // To be looked at.
    if (const char* path = std::getenv("CLVNDF_PAGE")) std::ofstream(path) << page;
}

TEST_CASE("a page shows what passes if all is asked for, the same each time") {
    const Report report = checked(false, Pictures::all);
    const std::string page = page_of(report, true);
    CHECK(unbalanced(page) == "");
    CHECK(count(page, "<figure>") == 12);
    CHECK(page.find("FAIL") == page.npos);
    CHECK_THAT(page, ContainsSubstring("1 of 1 functions pass"));
    CHECK(page == page_of(checked(false, Pictures::all), true));
    CHECK(checked(false, Pictures::failed).functions.front().pictures.empty());
    const std::string brief = page_of(report, false);
    CHECK((count(brief, "<figure>") == 0 && count(brief, "<section") == 0));
    CHECK((page.rfind("</figure>") - page.find("<figure>")) / 12 < 7200);
}

TEST_CASE("pictures of histograms have the colours of their cells") {
    std::vector<std::uint8_t> cells;
    for (std::size_t i = 0; i < 7 * 5; ++i)
        cells.push_back(static_cast<std::uint8_t>(i * i % residuals().size()));
    const std::string uri = image_of_cells(7, cells, residuals());
    const std::optional<std::string> file = gltf::data_of(uri);
    REQUIRE(file);
    render::Bitmap bitmap;
    const std::string wrong = gltf::decode_png(*file, 35, bitmap);
    if (wrong.find("no libpng") != wrong.npos) VNDF_SKIP(wrong);
    REQUIRE(wrong == "");
    REQUIRE((bitmap.width == 7 && bitmap.height == 5));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::uint32_t colour = residuals()[cells[i]], texel = bitmap.texels[i];
        CHECK(texel == (0xFF000000u | (colour & 255) << 16 | (colour & 0xFF00) | colour >> 16));
    }
}

TEST_CASE("colours of residuals tell too few from too many, to every kind of colour vision") {
    const auto part = [](std::uint32_t colour, int shift) { return static_cast<int>(colour >> shift & 255); };
    REQUIRE(residuals().size() == 15);
    for (std::size_t i = 0; i < 7; ++i) {
        const std::uint32_t few = residuals()[i], many = residuals()[14 - i];
        CHECK(part(few, 0) - part(few, 16) > 20);    // blue over red
        CHECK(part(many, 16) - part(many, 0) > 20);  // and the other way round
    }
    CHECK(deviations(400, 400) == 0);
    CHECK(deviations(420, 400) == Catch::Approx(1).epsilon(.05));
    CHECK(deviations(380, 400) == Catch::Approx(-1).epsilon(.05));
    CHECK(deviations(1, 0.01) < 1.5);  // one in many empty cells is nothing
}

namespace {

std::string unescaped(std::string text) {
    for (const auto& [entity, letter] :
         {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}})
        text = std::regex_replace(text, std::regex(entity), letter);
    return text;
}

// "wm_x=0.5, pdf=2" of a table with one row.
std::string in_words(const std::string& csv) {
    const auto lines = split(csv, '\n');
    REQUIRE(lines.size() >= 2);
    const auto names = split(lines[0], ','), numbers = split(lines[1], ',');
    REQUIRE(names.size() == numbers.size());
    std::string words;
    for (std::size_t i = 0; i < names.size(); ++i) words += (i ? ", " : "") + names[i] + "=" + numbers[i];
    return words;
}

// Commands of the page give the values that stand beside them. Returns their number; `reference` is in them, too, where exact
// values are.
std::size_t run_commands(const Folder& folder, const std::string& page, std::size_t most,
                         const std::function<std::string(const std::string&)>& reference) {
    static const std::regex command(
        "<pre>(printf [^\n]*)</pre><span class=small>gives ([^;<]*)(?:; exact ([^<]*))?<");
    const std::string path = "PATH=$(dirname \"$clvndf\"):$PATH\n";
    std::size_t commands = 0;
    for (std::sregex_iterator i(page.begin(), page.end(), command), end; i != end && commands < most;
         ++i, ++commands) {
        const std::string line = unescaped((*i)[1]), values = (*i)[2], exact = (*i)[3];
        CAPTURE(line);
        REQUIRE(shell(folder, path + line + " >out") == 0);
        CHECK(in_words(folder.read("out")) == values);
        if (exact.empty()) continue;
        REQUIRE(shell(folder, path + reference(line) + " >out") == 0);
        CHECK(in_words(folder.read("out")) == exact);
    }
    return commands;
}

}  // namespace

TEST_CASE("commands of the page run, and give the values beside them") {
    const Folder folder;
    const std::string name = "vndf_ggx_sample_wm_dupuy2023_with_pdf";
    REQUIRE(shell(folder, "\"$clvndf\" check --quick --only " + name +
                              " --math builtin --seed 2 --report 'a \"<b>\"/c' --all >out 2>err") == 0);
    const std::string page = folder.read("a \"<b>\"/c/index.html");
    CHECK(unbalanced(page) == "");
    CHECK(run_commands(folder, page, 3, [](const std::string& line) {
              return std::regex_replace(line, std::regex(" --math builtin"), " --on reference");
          }) == 3);
    CHECK_THAT(page, ContainsSubstring("clvndf check --only " + name + " --quick --seed 2 --math builtin"));
}

TEST_CASE("the page of a user's function shows it as ours, with commands that run") {
    const Folder folder;
    const std::string judge = CLVNDF_SOURCE_DIR "/tests/judge/";
    std::filesystem::copy_file(judge + "subtle.cl", folder / "it's.cl");
    REQUIRE(shell(folder,
                  "\"$clvndf\" check --quick --kernel \"it's.cl\" --function my_sample --as ggx_sample_wm "
                  "--options -DX --alpha 0.1:0.5 --isotropic --report page --all >out 2>err") == 1);
    const std::string page = folder.read("page/index.html");
    CHECK(unbalanced(page) == "");
    CHECK(count(page, "<figure>") == 12);
    CHECK(run_commands(folder, page, 1, {}) == 1);
    const std::string words =
        " --kernel 'it'\\''s.cl' --function my_sample --as ggx_sample_wm --options '-DX' "
        "--alpha 0.1:0.5 --isotropic --quick";
    CHECK_THAT(page, ContainsSubstring("clvndf check" + words) && ContainsSubstring("Not judged: "));
}

namespace {

constexpr const char* bsdf_words = " --function my_value --as bsdf --pdf my_pdf --sample my_sample";

// Of the lobes in a quick check of tests/judge/bsdf.cl with this mistake.
std::vector<LobePicture> pictures_of_bsdf(const std::string& mistake, Pictures pictures) {
    UserOptions user;
    user.file = CLVNDF_SOURCE_DIR "/tests/judge/bsdf.cl", user.options = "-D" + mistake;
    user.function = "my_value", user.as = "bsdf", user.pdf = "my_pdf", user.sample = "my_sample";
    const UserKernel kernel(user);
    runtime::DeviceEvaluator evaluator = kernel.evaluator(runtime::choose_device().device);
    CheckOptions options;
    options.quick = true, options.random_points = 4096, options.pictures = pictures;
    return check_user_kernel(kernel, evaluator, options).functions.back().pictures;
}

}  // namespace

TEST_CASE("lobes of a BSDF have pictures of what fails there, of its samples, its value or its density") {
    CHECK(pictures_of_bsdf("NONE", Pictures::failed).empty());
    CHECK(pictures_of_bsdf("NONE", Pictures::all).size() == 4);
    const std::vector<LobePicture> others = pictures_of_bsdf("OTHER_PDF", Pictures::failed);
    REQUIRE_FALSE(others.empty());
    double least = 0, most = 0;
    for (const LobePicture& picture : others) {
        CHECK_FALSE(picture.passed());
        const std::size_t bins = (picture.bins.theta.size() - 1) * (picture.bins.phi.size() - 1);
        REQUIRE(picture.directions.observed.size() == bins + 1);
        REQUIRE(picture.directions.expected.size() == bins + 1);
        double counted = 0;
        for (std::size_t i = 0; i <= bins; ++i) {
            const std::uint32_t observed = picture.directions.observed[i];
            const double sigma = deviations(observed, picture.directions.expected[i]);
            least = std::min(least, sigma), most = std::max(most, sigma), counted += observed;
        }
        CHECK(counted == bsdf_samples);
    }
    CHECK((least < -7 && most > 7));
    // Only the value's furnace fails: its lobe is drawn, and named for it.
    const std::vector<LobePicture> bright = pictures_of_bsdf("BRIGHT", Pictures::failed);
    REQUIRE_FALSE(bright.empty());
    for (const LobePicture& picture : bright) {
        CHECK((picture.tests[0].name == "furnace" && !picture.tests[0].passed()));
        CHECK(picture.tests[2].passed());
    }
}

TEST_CASE("the page of a BSDF shows the lobes that fail, and evaluates its worst inputs again") {
    const Folder folder;
    std::filesystem::copy_file(CLVNDF_SOURCE_DIR "/tests/judge/bsdf.cl", folder / "a b.cl");
    const std::string check =
        "\"$clvndf\" check --quick --points 4096 --kernel 'a b.cl'" + std::string(bsdf_words);
    REQUIRE(shell(folder, check + " --options -DOTHER_PDF --report page >out 2>err") == 1);
    const std::string page = folder.read("page/index.html"), text = folder.read("out");
    CHECK(unbalanced(page) == "");
    CHECK(count(page, "<figure>") > 0);
    CHECK_THAT(page, ContainsSubstring("FAIL chi2 of the samples against my_pdf p = ") &&
                         ContainsSubstring("all light: 0.") && ContainsSubstring("mean weight: 0."));
    CHECK(run_commands(folder, page, 99, {}) > 4);
    // The same commands stand in the text.
    static const std::regex again("again: (printf [^\n]*)\n  gives ([^\n]*)\n");
    std::size_t commands = 0;
    for (std::sregex_iterator i(text.begin(), text.end(), again), end; i != end; ++i, ++commands)
        CHECK_THAT(unescaped(page),
                   ContainsSubstring("<pre>" + (*i)[1].str() + "</pre><span class=small>gives " +
                                     (*i)[2].str() + "<"));
    CHECK(commands > 2);
    CHECK_THAT(
        text, ContainsSubstring("eval my_sample --kernel 'a b.cl' --as bsdf_sample --options '-DOTHER_PDF'"));
}

TEST_CASE("a function that is inexact has a page that says so, and where") {
    const Folder folder;
    REQUIRE(
        shell(folder,
              "cp '" CLVNDF_SOURCE_DIR "/tests/judge/inexact.cl' a.cl; \"$clvndf\" check --quick --kernel "
              "a.cl --function my_pdf --as ggx_pdf_wm --isotropic --alpha 0.1:1 --report page >out 2>err") ==
        0);
    const std::string page = folder.read("page/index.html");
    CHECK(unbalanced(page) == "");
    CHECK_THAT(page, ContainsSubstring("1 of 1 functions pass, 1 of them inexact") &&
                         ContainsSubstring("<h2>my_pdf: inexact</h2>"));
    CHECK(page.find("FAIL") == page.npos);
    CHECK(run_commands(folder, page, 1, [](const std::string& line) {
              return std::regex_replace(line, std::regex("eval my_pdf .*"),
                                        "eval vndf_ggx_pdf_wm --on reference");
          }) == 1);
}

TEST_CASE("a folder that cannot be is refused before the work, and nothing is left") {
    const Folder folder;
    folder.write("file", "");
    for (const auto& [arguments, said] : {std::pair("--report file", "file"),
                                          {"--report file/below", "file/below: cannot create this folder"},
                                          {"--all", "--all requires --report"},
                                          {"--report ''", "--report: its value is empty"},
                                          {"--report a --digest", "--digest"},
                                          {"--report a --json a/index.html", "one file"},
                                          {"--report a --device nosuch", "nosuch"}}) {
        INFO(arguments);
        CHECK(shell(folder,
                    "\"$clvndf\" check --only vndf_reflect " + std::string(arguments) + " >out 2>err") == 2);
        CHECK_THAT(folder.read("err"), ContainsSubstring(said));
        CHECK(count(folder.read("err"), "\n") == 1);
        CHECK(folder.read("out").empty());
        CHECK(folder.files() == 3);  // file, out, err
    }
}
