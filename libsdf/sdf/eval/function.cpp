#include "sdf/eval/function.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "sdf/eval/tape_compiler.h"
#include "sdf/expr/apply-inl.h"

namespace sdf {

struct Function::Compiled {
  std::vector<Expr> outputs;
  std::vector<ParameterInfo> inputs;
  TapePtr tape;  // at the defaults
  std::vector<UniformStep> steps;
  std::vector<InputPlace> places;

  // The tape's constants where inputs have these values.
  std::vector<double> constantsAt(const Values& values, std::vector<double> constants) const {
    for (const InputPlace& input : places)
      if (const auto it = values.find(input.parameter.parameterInfo().name); it != values.end()) {
        constants[input.place] = it->second;
      }
    for (const UniformStep& step : steps)
      constants[step.out] =
          evaluateOp<double>(step.op, step.payload, [&](int k) { return constants[step.in[k]]; });
    return constants;
  }
};

Function::Function(std::vector<Expr> outputs) {
  TapeCompiler compiler(outputs);
  auto compiled = std::make_shared<Compiled>();
  compiled->steps = compiler.takeSteps();
  compiled->places = compiler.takeInputs();
  compiled->tape = std::make_shared<const Tape>(compiler.take());
  for (const InputPlace& input : compiled->places) {
    const ParameterInfo& info = input.parameter.parameterInfo();
    if (std::ranges::find(compiled->inputs, info.name, &ParameterInfo::name) == compiled->inputs.end())
      compiled->inputs.push_back(info);
  }
  compiled->outputs = std::move(outputs);
  compiled_ = std::move(compiled);
}

const std::vector<Expr>& Function::outputs() const { return compiled_->outputs; }
const std::vector<ParameterInfo>& Function::inputs() const { return compiled_->inputs; }

bool Function::covers(const Values& values) const {
  return std::ranges::all_of(compiled_->places, [&](const InputPlace& input) {
    const auto it = values.find(input.parameter.parameterInfo().name);
    return it == values.end() || input.parameter.range().contains(it->second);
  });
}

TapePtr Function::at(const Values& values) const {
  const Tape& tape = *compiled_->tape;
  if (compiled_->places.empty() || values.empty()) return compiled_->tape;
  auto pool = std::make_shared<Tape::Pool>(*tape.pool_);
  pool->doubles = compiled_->constantsAt(values, std::move(pool->doubles));
  pool->floats.assign(pool->doubles.begin(), pool->doubles.end());
  std::shared_ptr<const Tape::Code> code = tape.code_;
  if (!covers(values)) {
    auto unbounded = std::make_shared<Tape::Code>(*code);
    for (Instruction& instruction : unbounded->instructions)
      instruction.lipschitz = std::numeric_limits<float>::infinity();
    unbounded->finish();
    code = std::move(unbounded);
  }
  return std::shared_ptr<const Tape>(new Tape(std::move(code), std::move(pool)));
}

std::vector<double> Function::uniform(const Values& values) const {
  const Tape& tape = *compiled_->tape;
  const std::vector<double> constants = compiled_->constantsAt(values, tape.pool_->doubles);
  std::vector<double> result;
  for (const Operand o : tape.outputs()) {
    assert(o.isConstant());
    result.push_back(constants[o.index()]);
  }
  return result;
}

}  // namespace sdf
