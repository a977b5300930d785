#include "bench/traffic/shader_accesses.hpp"

#include <algorithm>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#include <spirv/unified1/spirv.hpp11>
#include <string>
#include <unordered_map>

#include "gpu/workgroup_size.hpp"

namespace rill::bench {
namespace {

constexpr spv_target_env kEnvironment = SPV_ENV_VULKAN_1_3;

Error invalid(const std::string& what) { return {ErrorKind::Shader, "cannot reflect the accesses of a shader: " + what}; }

/// The module as the driver would see it after specialization: constants folded, one function, no code that is switched off.
Expected<std::vector<uint32_t>> specialized(std::span<const uint32_t> spirv, std::span<const uint32_t> constants) {
  std::string problem = "SPIR-V Tools gave no reason";
  spvtools::Optimizer optimizer(kEnvironment);
  optimizer.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* text) { problem = text; });
  std::unordered_map<uint32_t, std::vector<uint32_t>> values;
  for (uint32_t id = 0; id < constants.size(); ++id) values[id] = {constants[id]};
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPerformancePasses();
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);
  std::vector<uint32_t> words;
  if (!optimizer.Run(spirv.data(), spirv.size(), &words, options)) return invalid(problem);
  return words;
}

/// One pass over the instructions. Ids are defined before they are used, but for the labels of merge blocks.
class Walk {
 public:
  void visit(const spv_parsed_instruction_t& i) {
    using spv::Op;
    const auto op = static_cast<Op>(i.opcode);
    const auto operand = [&](uint16_t k) { return i.words[i.operands[k].offset]; };
    switch (op) {
      case Op::OpDecorate:
        if (operand(1) == uint32_t(spv::Decoration::Binding)) binding_[operand(0)] = operand(2);
        break;
      case Op::OpConstant:
        constant_[i.result_id] = operand(2);
        break;
      case Op::OpTypeInt:
      case Op::OpTypeFloat:
        bytes_[i.result_id] = operand(1) / 8;
        break;
      case Op::OpTypeVector:
      case Op::OpTypeMatrix:
        bytes_[i.result_id] = bytes_[operand(1)] * operand(2);
        break;
      case Op::OpTypeArray:
        bytes_[i.result_id] = bytes_[operand(1)] * constant_[operand(2)];
        break;
      case Op::OpTypeStruct:
        for (uint16_t k = 1; k < i.num_operands; ++k) bytes_[i.result_id] += bytes_[operand(k)];
        break;
      case Op::OpVariable:
        if (binding_.contains(i.result_id)) origin_[i.result_id] = i.result_id;
        break;
      case Op::OpAccessChain:
      case Op::OpInBoundsAccessChain:
      case Op::OpCopyObject:
      case Op::OpImage:
      case Op::OpSampledImage:
      case Op::OpImageTexelPointer:
        follow(i.result_id, operand(2));
        break;
      case Op::OpLoad: {
        // The load of an image or texel buffer is its handle; what is fetched through it comes later.
        const auto size = bytes_.find(i.type_id);
        if (size == bytes_.end())
          follow(i.result_id, operand(2));
        else
          add(operand(2), size->second, true, false);
        break;
      }
      case Op::OpStore: {
        const auto type = typeOf_.find(operand(1));
        add(operand(0), type == typeOf_.end() ? 4 : bytes_[type->second], false, true);
        break;
      }
      case Op::OpImageFetch:
      case Op::OpImageRead:
        add(operand(2), bytes_[i.type_id], true, false);
        break;
      case Op::OpImageWrite:
        add(operand(0), bytes_[typeOf_[operand(2)]], false, true);
        break;
      case Op::OpAtomicStore:
        add(operand(0), 4, false, true);
        break;
      case Op::OpAtomicLoad:
        add(operand(2), 4, true, false);
        break;
      case Op::OpLoopMerge:
        merges_.push_back(operand(0));
        break;
      case Op::OpLabel:
        while (!merges_.empty() && merges_.back() == i.result_id) merges_.pop_back();
        break;
      default:
        if (i.opcode >= uint16_t(Op::OpAtomicExchange) && i.opcode <= uint16_t(Op::OpAtomicXor)) add(operand(2), 4, true, true);
    }
    if (i.type_id && i.result_id) typeOf_[i.result_id] = i.type_id;
  }

  std::vector<BindingAccess> bindings;

 private:
  void follow(uint32_t result, uint32_t from) {
    if (const auto found = origin_.find(from); found != origin_.end()) origin_[result] = found->second;
  }
  void add(uint32_t pointer, uint32_t bytes, bool reads, bool writes) {
    const auto found = origin_.find(pointer);
    if (found == origin_.end()) return;  // a local or shared variable, or a push constant
    const uint32_t binding = binding_[found->second];
    if (binding >= bindings.size()) bindings.resize(binding + 1);
    BindingAccess& access = bindings[binding];
    const bool loop = !merges_.empty();
    access.reads |= reads;
    access.writes |= writes;
    access.readsInLoop |= reads && loop;
    access.writesInLoop |= writes && loop;
    if (reads) access.readBytes = std::max(access.readBytes, bytes);
    if (writes) access.writeBytes = std::max(access.writeBytes, bytes);
  }

  std::unordered_map<uint32_t, uint32_t> binding_, constant_, bytes_, origin_, typeOf_;
  std::vector<uint32_t> merges_;  ///< of the loops around the block
};

}  // namespace

Expected<ShaderAccesses> shaderAccesses(std::span<const uint32_t> spirv, std::span<const uint32_t> constants) {
  auto words = specialized(spirv, constants);
  if (!words) return words.error();
  Walk walk;
  const spv_context context = spvContextCreate(kEnvironment);
  spv_diagnostic diagnostic = nullptr;
  const spv_result_t result = spvBinaryParse(
      context, &walk, words->data(), words->size(), nullptr,
      [](void* self, const spv_parsed_instruction_t* instruction) {
        static_cast<Walk*>(self)->visit(*instruction);
        return SPV_SUCCESS;
      },
      &diagnostic);
  const std::string problem = diagnostic ? diagnostic->error : "it cannot be parsed";
  spvDiagnosticDestroy(diagnostic);
  spvContextDestroy(context);
  if (result != SPV_SUCCESS) return invalid(problem);
  return ShaderAccesses{std::move(walk.bindings), static_cast<uint32_t>(workgroupSize(spirv, constants).invocations())};
}

}  // namespace rill::bench
