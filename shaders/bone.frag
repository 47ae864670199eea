// Bone: key light over the left shoulder, cool fill from the lower right, rim from behind, sky and
// ground through the baked occlusion, and the shade that the probe throws.
in vec3 v_position;
#if defined(CHANGED) || defined(HEATED)
in vec3 v_model;
#endif
in vec3 v_normal;
in vec4 v_shade;  // openness, cavity, mottle, height of what is felt

uniform vec4 u_color;      // display colour and opacity
uniform int u_felt;         // 1: coloured by that height
uniform int u_wound;        // 1: skin that was cut open; that height says how deep it lies in a cut
uniform vec3 u_felt_low;    // display colours of its range
uniform vec3 u_felt_none;
uniform vec3 u_felt_high;
uniform vec4 u_tool_tip;    // view space; w the radius, 0 without a tool
uniform vec3 u_tool_start;  // axis of the shaft
uniform vec3 u_tool_end;
uniform vec2 u_tool_reach;  // no shade further than this: of its closeness, of its shadow; metres

#ifdef HEATED
uniform sampler3D u_heat;       // of cells of the bone: its hottest temperature, whether it is dead
uniform vec4 u_heat_from;       // middle of the first cell in Model, and the side of a cell
uniform vec2 u_heat_range;      // temperatures that 0 and 1 stand for, C
uniform float u_heat_stops[5];  // where these colours stand
uniform vec3 u_heat_colors[5];
uniform vec3 u_heat_dead;
#endif

out vec4 o_color;

#ifdef HEATED
// Cooler than the first stop bone keeps its own colour; up to there nothing jumps.
vec3 heated(vec3 albedo, vec3 model) {
  const float kBlend = 1.0;  // degrees over which the first colour comes
  vec3 place = (model - u_heat_from.xyz) / u_heat_from.w + 0.5;
  vec2 heat = texture(u_heat, place / vec3(textureSize(u_heat, 0))).rg;
  float celsius = mix(u_heat_range.x, u_heat_range.y, heat.r);
  vec3 color = u_heat_colors[0];
  for (int k = 1; k < 5; ++k) {
    float way = (celsius - u_heat_stops[k - 1]) / (u_heat_stops[k] - u_heat_stops[k - 1]);
    color = mix(color, u_heat_colors[k], clamp(way, 0.0, 1.0));
  }
  color = mix(color, u_heat_dead, smoothstep(0.35, 0.65, heat.g));
  float shown = clamp((celsius - u_heat_stops[0]) / kBlend, 0.0, 1.0);
  return mix(albedo, to_linear(color), shown);
}
#endif

// In a cut of skin: its section, which blood reddens where it ends, and yellow fat under it, whose
// floor is wet and redder.
vec3 wound_color(float depth_mm) {
  const vec3 kSection = vec3(0.90, 0.62, 0.56), kBlood = vec3(0.66, 0.16, 0.13);
  const vec3 kFat = vec3(1.00, 0.82, 0.52), kFloor = vec3(0.97, 0.68, 0.42);
  vec3 color = mix(kSection, kBlood, 0.75 * exp(-pow((depth_mm - 2.0) / 0.35, 2.0)));
  color = mix(color, kFat, smoothstep(2.0, 2.5, depth_mm));
  return mix(color, kFloor, smoothstep(3.5, 7.0, depth_mm));
}

// Share of the sky that a ball hides from a surface point: to_ball leads to its centre.
float hidden_by_ball(vec3 to_ball, vec3 n, float radius) {
  float d2 = max(dot(to_ball, to_ball), radius * radius);
  float fade = clamp(1.0 - d2 / (u_tool_reach.x * u_tool_reach.x), 0.0, 1.0);
  return max(dot(n, to_ball) * inversesqrt(d2), 0.0) * radius * radius / d2 * fade;
}

// Share of light that the tool leaves: soft shade where the key light's path passes near the
// shaft, and the closeness of the tip and the shaft themselves.
float tool_light(vec3 p, vec3 n) {
  float radius = u_tool_tip.w;
  vec3 shaft = u_tool_end - u_tool_start;
  vec3 from_start = p - u_tool_start;
  float b = dot(shaft, shaft);
  // Nearest point of the shaft to p.
  float s = clamp(dot(from_start, shaft) / b, 0.0, 1.0);
  float near = max(hidden_by_ball(u_tool_tip.xyz - p, n, 1.4 * radius),
                   hidden_by_ball(shaft * s - from_start, n, radius));
  // Nearest approach of the line p + t key to the line of the shaft.
  float a = dot(u_key_dir, shaft);
  float t = (dot(from_start, shaft) * a - dot(u_key_dir, from_start) * b) / max(b - a * a, 1e-9);
  t = max(t, 0.0);
  float along = clamp(dot(from_start + t * u_key_dir, shaft) / b, 0.0, 1.0);
  float gap = length(from_start + t * u_key_dir - shaft * along);
  float soft = radius + 0.25 * t;
  float shadow = (1.0 - smoothstep(0.5 * radius, radius + soft, gap)) * radius / soft;
  shadow *= 1.0 - smoothstep(0.5, 1.0, t / u_tool_reach.y);
  return (1.0 - 0.7 * near) * (1.0 - 0.65 * shadow);
}

void main() {
#ifdef CHANGED
  if (is_left_out(v_model)) discard;
#endif
  vec3 n = normalize(v_normal);
  vec3 v = to_viewer(v_position);
  if (!gl_FrontFacing) n = -n;
  float facing = clamp(dot(n, v), 0.0, 1.0);

  vec3 albedo = to_linear(u_color.rgb);
  float mottle = v_shade.z - 0.5;
  albedo *= 1.0 + vec3(0.16, 0.20, 0.30) * mottle;
  if (u_felt == 1) {
    float height = clamp((v_shade.w * 255.0 - 128.0) / 127.0, -1.0, 1.0);
    albedo = to_linear(mix(u_felt_none, height < 0.0 ? u_felt_low : u_felt_high, abs(height)));
  }
  float deep = (v_shade.w * 255.0 - 129.0) / 126.0;
  if (u_wound == 1 && deep > -0.004) albedo = to_linear(wound_color(12.0 * max(deep, 0.0)));
#ifdef HEATED
  albedo = heated(albedo, v_model);
#endif
  float cavity = v_shade.y * 2.0 - 1.0;
  albedo *= 1.0 + vec3(0.38, 0.44, 0.52) * clamp(cavity, -1.0, 0.55);

  float open = mix(1.0, v_shade.x, u_occlusion);
  // Light bounced between bones keeps their warmth: red is lost last.
  vec3 sky_light = open * open * mix(vec3(1.0), vec3(open), vec3(0.0, 0.45, 0.85));

  float key = clamp((dot(n, u_key_dir) + 0.12) / 1.12, 0.0, 1.0);
  float fill = clamp(dot(n, vec3(0.64, -0.38, 0.67)) * 0.6 + 0.4, 0.0, 1.0);
  vec3 h = normalize(u_key_dir + v);
  float shine = max(dot(n, h), 0.0);  // to the 32nd power
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  float edge = 1.0 - facing;
  edge *= edge * edge;
  float rim = edge * clamp(0.35 + 0.65 * dot(n.xy, vec2(0.45, 0.89)), 0.0, 1.0);

  float shade = u_tool_tip.w > 0.0 ? tool_light(v_position, n) : 1.0;
  vec3 hemisphere = mix(vec3(0.030, 0.034, 0.046), vec3(0.150, 0.160, 0.185), n.y * 0.5 + 0.5);
  vec3 light = u_key_strength * vec3(1.06, 0.99, 0.89) * key * shade * mix(vec3(1.0), sky_light, 0.75);
  light += (hemisphere + vec3(0.060, 0.076, 0.105) * fill * fill) * sky_light * (0.5 + 0.5 * shade);
  vec3 color = albedo * light;
  color += u_key_strength * 0.085 * shine * shade * open;
  color += vec3(0.26, 0.30, 0.38) * rim * open;

  // See-through bone keeps its outline: it is thickest where it turns away.
  float opacity = u_color.a < 1.0 ? mix(u_color.a, 1.0, 0.55 * edge) : 1.0;
  o_color = vec4(display(color), opacity);
}
