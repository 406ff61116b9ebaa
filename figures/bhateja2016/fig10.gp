# Fig. 10: alpha over [W_f, W_2] against e_p, mu_p and N (above) and the two ends of that range
# (below). Grey: what other methods and ends times 0.7 and 1.4 make of alpha. Open: alpha over
# 10 <= W <= 90 for all.
load 'style.gp'
set multiplot
with_fit(c, name, value) = strcol(c) eq name ? value : NaN
do for [panel = 1:3] {
  if (panel == 1) { file = restitution; ends = restitution_ends; cx = restitution_e_p; cf = restitution_fit; ca = restitution_alpha; cs = restitution_alpha_se; low = restitution_low; high = restitution_high; ex = restitution_ends_e_p; ep = restitution_ends_parameter; ev = restitution_ends_value; el = restitution_ends_lower95; eh = restitution_ends_upper95; label = '{/:Italic e}_p' }
  if (panel == 2) { file = friction; ends = friction_ends; cx = friction_mu_p; cf = friction_fit; ca = friction_alpha; cs = friction_alpha_se; low = friction_low; high = friction_high; ex = friction_ends_mu_p; ep = friction_ends_parameter; ev = friction_ends_value; el = friction_ends_lower95; eh = friction_ends_upper95; label = 'μ_p' }
  if (panel == 3) { file = layers; ends = layers_ends; cx = layers_N; cf = layers_fit; ca = layers_alpha; cs = layers_alpha_se; low = layers_low; high = layers_high; ex = layers_ends_N; ep = layers_ends_parameter; ev = layers_ends_value; el = layers_ends_lower95; eh = layers_ends_upper95; label = '{/:Italic N}' }
  set lmargin at screen 0.07 + 0.33 * (panel - 1)
  set rmargin at screen 0.32 + 0.33 * (panel - 1)
  if (panel == 1) { set xrange [0.65:1] }
  if (panel == 2) { set xrange [-0.05:0.85] }
  if (panel == 3) { set xrange [0:21] }
  set tmargin at screen 0.97
  set bmargin at screen 0.52
  unset logscale
  set yrange [0:2.2]
  set xlabel ''
  set format x ''
  set ylabel 'α' offset 1
  set key at graph 0.97, 0.04 right bottom Left reverse font ',10.5' samplen 1.5
  plot file using (with_fit(cf, 'alpha', column(cx))):(column(ca)):(column(low)):(column(high)) \
         with yerrorbars pointtype 0 linewidth 6 linecolor rgb light title 'other methods and ranges', \
       file using (with_fit(cf, 'alpha', column(cx))):(column(ca)):(column(cs)) \
         with yerrorlines pointtype 7 pointsize 0.8 linewidth 1.2 linecolor rgb blue title 'over [{/:Italic W}_f, {/:Italic W}_2]', \
       file using (with_fit(cf, 'alpha-fixed-range', column(cx))):(column(ca)):(column(cs)) \
         with yerrorbars pointtype 6 pointsize 0.8 linewidth 1.2 linecolor rgb vermillion title 'over [10, 90]'
  set tmargin at screen 0.49
  set bmargin at screen 0.10
  set format x '%g'
  set xlabel label
  set ylabel '{/:Italic W}'
  set yrange [1:200]
  set logscale y
  set key at graph 0.97, 0.55 right bottom Left reverse font ',10.5' samplen 1.5
  plot ends using (with_fit(ep, 'W_2', column(ex))):(column(ev)):(column(el)):(column(eh)) \
         with yerrorlines pointtype 5 pointsize 0.8 linewidth 1.2 linecolor rgb green title '{/:Italic W}_2, 95 %', \
       ends using (with_fit(ep, 'W_f', column(ex))):(column(ev)):(column(el)):(column(eh)) \
         with yerrorlines pointtype 9 pointsize 0.8 linewidth 1.2 linecolor rgb orange title '{/:Italic W}_f, 95 %'
}
unset multiplot
