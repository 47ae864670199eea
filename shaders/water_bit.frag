// A bubble of air or a flake of loose tissue in a scope's light. Writes linear light; a flake its
// distance from the eye as tissue does, a bubble how much it hides, its light scaled by that.
in vec3 v_position;
in vec2 v_in_square;
in vec2 v_kind;

out vec4 o_light;

float hash(vec3 p) {
  p = fract(p * vec3(0.1031, 0.1030, 0.0973));
  p += dot(p, p.yxz + 33.33);
  return fract((p.x + p.y) * p.z);
}

float noise(vec3 p) {
  vec3 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  float a = mix(mix(hash(i), hash(i + vec3(1, 0, 0)), f.x),
                mix(hash(i + vec3(0, 1, 0)), hash(i + vec3(1, 1, 0)), f.x), f.y);
  float b = mix(mix(hash(i + vec3(0, 0, 1)), hash(i + vec3(1, 0, 1)), f.x),
                mix(hash(i + vec3(0, 1, 1)), hash(i + vec3(1, 1, 1)), f.x), f.y);
  return mix(a, b, f.z);
}

// Light from the tip, as tissue.frag has it.
float fall_at(float distance_m, float forward) {
  return 1e-4 / (distance_m * distance_m + 4e-6) * smoothstep(0.45, 0.90, forward);
}

// Air in water throws back all light beyond 48.6 degrees, three quarters of the way to its rim: a
// ring that mirrors the lit walls around, dark at its edge. Through its middle one looks. The
// scope's light is mirrored near the middle, and once more by the far side.
vec4 bubble(vec2 at, float fall) {
  float r = length(at);
  if (r > 1.0) discard;
  float ring = smoothstep(0.62, 0.80, r), edge = smoothstep(0.84, 1.0, r);
  float hides = (0.06 + 0.74 * ring) * (1.0 - smoothstep(0.97, 1.0, r));
  vec3 walls = vec3(0.34, 0.27, 0.24) * (0.75 + 0.35 * at.y);
  vec3 light = mix(walls, vec3(0.03, 0.02, 0.02), edge) * fall;
  float spark = 1.0 - smoothstep(0.06, 0.15, length(at - vec2(0.0, 0.16)));
  float second = (1.0 - smoothstep(0.05, 0.12, abs(r - 0.70))) * smoothstep(0.5, 1.0, -at.y / max(r, 1e-3));
  vec3 shine = (6.0 * spark + 0.5 * second) * fall * vec3(1.0, 0.99, 0.97);
  return vec4(light * hides + shine, max(hides, spark));
}

// A torn shred: longer than wide, with a ragged rim and strands along it, thin at its ends.
vec3 flake(vec2 at, float shape, vec3 n, float fall) {
  float ragged = 0.55 * noise(vec3(3.1 * at, 40.0 * shape)) + 0.25 * noise(vec3(9.0 * at, 17.0 * shape));
  float bend = 0.35 * (noise(vec3(1.7 * at.x, 3.0, 60.0 * shape)) - 0.5);
  float rim = length(vec2(at.x, 1.35 * (at.y - bend))) + ragged;
  if (rim > 1.0) discard;
  float strand = noise(vec3(2.0 * at.x, 14.0 * at.y, 25.0 * shape));
  vec3 c = mix(vec3(0.62, 0.46, 0.38), vec3(0.82, 0.73, 0.63), strand);
  float straight = abs(dot(n, normalize(v_position)));
  float thick = 1.0 - smoothstep(0.7, 1.0, rim);
  return c * c * fall * (0.25 + 0.65 * straight) * (0.6 + 0.4 * thick);
}

void main() {
  // Slopes are worked out before anything is left out.
  vec3 n = normalize(cross(dFdx(v_position), dFdy(v_position)) + vec3(0.0, 0.0, 1e-20));
  float distance_m = length(v_position);
  float fall = fall_at(distance_m, -v_position.z / distance_m);
  if (v_kind.x < 0.5)
    o_light = bubble(v_in_square, fall);
  else
    o_light = vec4(flake(v_in_square, v_kind.y, n, fall), distance_m);
}
