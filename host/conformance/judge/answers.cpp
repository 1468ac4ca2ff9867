#include "conformance/judge/answers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conformance/judge/digest.h"
#include "conformance/judge/errors.h"
#include "kernels/vndf/vndf.h"
#include "text.h"

namespace vndf::conformance {

std::string format_answers(runtime::Evaluator& evaluator, runtime::Math math,
                           const std::vector<const Function*>& selected) {
    std::string text = fmt::format(
        "# Known answers of clvndf, {}, {}, VNDF_BITS_VERSION {}: NAME,INPUT...,RESULT... in C99 hex "
        "floats.\n"
        "# In the public domain (CC0 1.0); clvndf check --digest --answers makes them.\n",
        to_string(math), to_string(evaluator.input_real()), VNDF_BITS_VERSION);
    for (const Function* function : selected) {
        const Table table = digest_inputs(*function, answer_rows, evaluator.input_real());
        const auto results = evaluate(evaluator, *function, table);
        text += fmt::format("# {}: {} -> {}\n", function->name, fmt::join(function->inputs, ","),
                            fmt::join(function->outputs, ","));
        for (std::size_t i = 0; i < table.rows(); ++i) {
            text += function->name;
            for (const auto& column : table.columns) (text += ',') += hex_number(column[i]);
            for (const auto& column : results) (text += ',') += hex_number(column[i]);
            text += '\n';
        }
    }
    return text;
}

}  // namespace vndf::conformance
