#pragma once
#include "rig/head_parts.h"
#include "rig/head_slits.h"
#include "rig/template_match.h"

#include <vector>

namespace daumier::rig {

/// Carries targets of a registered template to the places of a head of another topology: 3P x T from offsets of the
/// template, 3V x T. A place of the skin takes
///   m = sum_k b_k o_k
/// of the nearest point of the template (barycentrics b, offsets o of its triangle) among those that face as it does and
/// are not on the other side of its slit, with a trust w that falls from 1 at 0.25 cm to 0 at 0.8 cm from it. Then
///   min_d sum_p w_p / (1.001 - w_p) |d_p - m_p|^2 + 0.05 sum over edges |d_p - d_q|^2
/// fills what has no such point (the bag of a mouth, the back of a lid) from what is around it. An edge of the head that
/// joins places of both sides of a slit, between which the way along the template is longer than twice the edge and 0.15 cm,
/// as where a slit of the head ends before that of the template, takes the trust away within 0.6 cm along the surface.
/// Places farther than 3 cm from the template, other than around a slit, stay.
/// Places of attached parts take what the nearest place of the skin has, less with its distance: nothing from 3 cm on.
/// Parts of eyes and of the mouth do not move. head: in the frame of the template. On all cores.
/// @throws Error if the system has no solution.
Eigen::MatrixXf CarryTargets(const TemplateMatch& match, const HeadSurface& head, const HeadParts& parts,
                             const std::vector<FaceSide>& sides, const Eigen::MatrixXf& offsets);

}  // namespace daumier::rig
