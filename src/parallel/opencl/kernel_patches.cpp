#include "parallel/opencl/kernel_patches.hpp"

#include <algorithm>

#include "core/base/number_text.hpp"
#include "parallel/opencl/contact_constants.hpp"
#include "parallel/opencl/kernel_sources.hpp"

namespace holdfast::internal {

namespace {

std::string define(const char* name, double value) {
  return std::string("#define ") + name + " " + number_text(value) + "f\n";
}

std::size_t count(std::string_view text, std::string_view wanted) {
  std::size_t found = 0;
  for (std::size_t at = text.find(wanted); at != std::string_view::npos; at = text.find(wanted, at + wanted.size()))
    ++found;
  return found;
}

std::vector<KernelPatch> make_patches() {
  const char* const setup = "void ContactToConstraintKernel(";
  const char* const solve = "void BatchSolveKernelContact(";
  const char* const kernel_head = "__kernel\n__attribute__((reqd_work_group_size(WG_SIZE,1,1)))\n";
  return {
      // Original: friction 0.7 and restitution 0 for every pair, a step of 1/60 s, a penetration slop of 5 mm.
      {"contact setup: code", setup, std::string(kernel_head) + setup,
       define("HOLDFAST_MARGIN", kShapeMargin) + define("HOLDFAST_EDGE_OVERLAP", kEdgeOverlap) +
           define("HOLDFAST_ERP", kErp) + define("HOLDFAST_REBOUND_SPEED", kReboundSpeed) + kContactSetupSource +
           kernel_head + setup},
      {"contact setup: call", setup, "cs.m_batchIdx = gContact[gIdx].m_batchIdx;\n",
       "cs.m_batchIdx = gContact[gIdx].m_batchIdx;\n"
       "holdfast_prepare_contact(&cs, &gContact[gIdx], gBodies, gShapes, aIdx, bIdx);\n"},

      // Original: four sweeps for the normals, then four for friction, with damping about the normal. Here each sweep
      // has
      // both, and the setting gives the number of sweeps.
      {"contact solve: code", solve, std::string(kernel_head) + solve,
       kContactSolveSource + std::string(kernel_head) + solve},
      {"contact solve: call", solve, "\t\t\t\t\tsolveContactConstraint( gBodies, gShapes, &gConstraints[idx] );\n",
       "holdfast_solve_contact(gBodies, gShapes, &gConstraints[idx]);\n"},
      {"contact solve: sweeps", solve, "\tint idx=ldsStart+lIdx;\n\twhile (ldsCurBatch < maxBatch)\n",
       "const int sweeps = (int)gBodies[gConstraints[start].m_bodyA].m_frictionCoeff;\n"
       "for (int sweep = 0; sweep < sweeps; ++sweep) {\n"
       "GROUP_LDS_BARRIER;\nif (lIdx == 0) ldsCurBatch = 0;\nGROUP_LDS_BARRIER;\n"
       "int idx = start + lIdx;\nwhile (ldsCurBatch < maxBatch)\n"},
      {"contact solve: end of sweeps", solve, "}\n__kernel void solveSingleContactKernel(",
       "}\n}\n__kernel void solveSingleContactKernel("},
      // A batch reads velocities that other work-items have written in the previous batch.
      {"contact solve: barrier", solve, "barrier(CLK_LOCAL_MEM_FENCE)",
       "barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE)"},
      {"friction solve: none of its own", "void BatchSolveKernelFriction(", "\tif( gN[cellIdx] == 0 ) \n",
       "\tif (gN[cellIdx] >= 0)\n"},

      // Original: contacts are solved by position, in cells of 6 m. Here each world has its own cell.
      {"contact order", "void SetSortDataKernel(", "int newIndex = (xIdx+yIdx*nSplit.x+zIdx*nSplit.x*nSplit.y);",
       "int newIndex = (int)gBodies[idx].m_restituitionCoeff & (nSplit.x * nSplit.y * nSplit.z - 1);"},

      // Original: 1 % of the angular velocity is lost per step.
      {"integrate: x damping", "integrateTransformsKernel(", "bodies[nodeID].m_angVel.x *= angularDamping;", ""},
      {"integrate: y damping", "integrateTransformsKernel(", "bodies[nodeID].m_angVel.y *= angularDamping;", ""},
      {"integrate: z damping", "integrateTransformsKernel(", "bodies[nodeID].m_angVel.z *= angularDamping;", ""},
  };
}

}  // namespace

const std::vector<KernelPatch>& kernel_patches() {
  static const std::vector<KernelPatch> kPatches = make_patches();
  return kPatches;
}

std::string KernelPatcher::patched(std::string_view source) {
  std::string text(source);
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const KernelPatch& patch = patches_[i];
    if (text.find(patch.program) == std::string::npos) continue;
    if (count(text, patch.find) == 1) {
      text.replace(text.find(patch.find), patch.find.size(), patch.replace);
      applied_[i] = true;
    } else {
      misfits_.push_back(patch.name);
    }
  }
  return text;
}

std::vector<std::string> KernelPatcher::unapplied() const {
  std::vector<std::string> names = misfits_;
  for (std::size_t i = 0; i < patches_.size(); ++i)
    if (!applied_[i] && std::find(names.begin(), names.end(), patches_[i].name) == names.end())
      names.push_back(patches_[i].name);
  return names;
}

}  // namespace holdfast::internal
