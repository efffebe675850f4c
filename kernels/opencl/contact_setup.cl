// Inserted into Bullet's program that turns contacts into constraints (patch "contact setup" of kernel_patches.cpp).
// It gives a constraint the contact law of this project instead of Bullet's constants.

// Gap between two boxes along a unit axis, m; negative: they overlap. The half extents are relative to the centres.
float holdfast_gap_along(b3Float4 axis, b3Float4 offset, b3Mat3x3 a, b3Float4 half_a, b3Mat3x3 b, b3Float4 half_b) {
  b3Float4 in_a = mtMul3(axis, a);
  b3Float4 in_b = mtMul3(axis, b);
  float reach_a = b3Dot3F4(fabs(in_a), half_a);
  float reach_b = b3Dot3F4(fabs(in_b), half_b);
  return fabs(b3Dot3F4(axis, offset)) - reach_a - reach_b;
}

b3Float4 holdfast_column(b3Mat3x3 m, int i) {
  b3Float4 unit = b3MakeFloat4(i == 0 ? 1.f : 0.f, i == 1 ? 1.f : 0.f, i == 2 ? 1.f : 0.f, 0.f);
  return mtMul1(m, unit);
}

// True when two boxes do not overlap along one of their axes that is perpendicular to the contact normal. Then only their
// margins touch, at an edge, and the contact would be an internal edge in a flat floor.
bool holdfast_is_phantom(b3Float4 normal, b3Float4 offset, b3Mat3x3 a, b3Float4 half_a, b3Mat3x3 b, b3Float4 half_b) {
  if (half_a.x <= 0.f || half_b.x <= 0.f) return false;
  for (int i = 0; i < 6; ++i) {
    b3Float4 axis = i < 3 ? holdfast_column(a, i) : holdfast_column(b, i - 3);
    if (fabs(b3Dot3F4(axis, normal)) > 0.7f) continue;
    if (holdfast_gap_along(axis, offset, a, half_a, b, half_b) > -HOLDFAST_EDGE_OVERLAP) return true;
  }
  return false;
}

// The point of a box nearest to `point`.
b3Float4 holdfast_nearest(b3Float4 point, b3Float4 centre, b3Mat3x3 rotation, b3Float4 half_extents) {
  if (half_extents.x <= 0.f) return point;
  return centre + mtMul1(rotation, clamp(mtMul3(point - centre, rotation), -half_extents, half_extents));
}

// Extent of the margin along a direction, relative to its thickness: 1 at a face, √2 and more at edges and corners.
float holdfast_margin_along(b3Float4 direction, b3Mat3x3 rotation) {
  b3Float4 inside = fabs(mtMul3(direction, rotation));
  return inside.x + inside.y + inside.z;
}

void holdfast_prepare_contact(b3ContactConstraint4_t* cs, __global const struct b3Contact4Data* contact,
                              __global const b3RigidBodyData_t* bodies, __global const b3InertiaData_t* inertias, int a,
                              int b) {
  b3Mat3x3 one = inertias[a].m_initInvInertia;
  b3Mat3x3 other = inertias[b].m_initInvInertia;
  b3Mat3x3 column_a = inertias[a].m_invInertiaWorld;
  b3Mat3x3 column_b = inertias[b].m_invInertiaWorld;
  b3Float4 half_a = b3MakeFloat4(column_a.m_row[0].w, column_a.m_row[1].w, column_a.m_row[2].w, 0.f);
  b3Float4 half_b = b3MakeFloat4(column_b.m_row[0].w, column_b.m_row[1].w, column_b.m_row[2].w, 0.f);
  b3Mat3x3 rotation_a = b3QuatGetRotationMatrix(bodies[a].m_quat);
  b3Mat3x3 rotation_b = b3QuatGetRotationMatrix(bodies[b].m_quat);
  b3Float4 position_a = bodies[a].m_pos;
  b3Float4 position_b = bodies[b].m_pos;
  float steps_per_second = max(one.m_row[0].w, other.m_row[0].w);
  float restitution = min(one.m_row[1].w, other.m_row[1].w);
  b3Float4 normal = contact->m_worldNormalOnB;
  normal.w = 0.f;
  // The shapes are larger than the boxes by a margin on every side.
  float margins =
      HOLDFAST_MARGIN * (holdfast_margin_along(normal, rotation_a) + holdfast_margin_along(normal, rotation_b));

  for (int i = 0; i < 4; ++i) {
    if (i >= contact->m_worldNormalOnB.w) continue;
    b3Float4 point = contact->m_worldPosB[i];
    float gap = point.w + margins;
    point.w = 0.f;
    point = holdfast_nearest(point, position_a, rotation_a, half_a);
    point = holdfast_nearest(point, position_b, rotation_b, half_b);
    cs->m_worldPos[i] = point;
    b3Float4 velocity_a = bodies[a].m_linVel + b3Cross3(bodies[a].m_angVel, point - position_a);
    b3Float4 velocity_b = bodies[b].m_linVel + b3Cross3(bodies[b].m_angVel, point - position_b);
    float speed = b3Dot3F4(normal, velocity_a - velocity_b);
    // A gap may close within the step, and no faster; a fraction of a penetration is corrected.
    float bias = (gap > 0.f ? gap : HOLDFAST_ERP * gap) * steps_per_second;
    bool meet = gap * steps_per_second + speed <= 0.f;
    if (meet && speed < -HOLDFAST_REBOUND_SPEED) bias = min(bias, restitution * speed);
    cs->m_b[i] = bias;
  }
  cs->m_linear.w = one.m_row[2].w * other.m_row[2].w;  // friction of the pair
  cs->m_center.w = 0.f;                                // accumulated impulse against spin

  if (holdfast_is_phantom(normal, position_b - position_a, rotation_a, half_a, rotation_b, half_b)) {
    for (int i = 0; i < 4; ++i) cs->m_jacCoeffInv[i] = 0.f;
    cs->m_fJacCoeffInv[0] = 0.f;
    cs->m_fJacCoeffInv[1] = 0.f;
  }
}
