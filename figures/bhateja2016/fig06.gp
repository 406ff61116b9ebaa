# Fig. 6: the exponent of T_z ~ V_p^alpha without gravity. Open: several amplitudes at N = 4; filled:
# several number densities at A = d (n = N/(10 d^3)), as in the paper; beside them restitution and friction.
load 'style.gp'
set multiplot
set tmargin at screen 0.965
set bmargin at screen 0.15
set yrange [1.8:2.2]
kind(word) = strcol(exponents_series)[1:strlen(word)] eq word
fixed(n) = strstrt(strcol(exponents_series), 'fixed lid') > 0
array panel_x[3] = [exponents_amplitude, exponents_layers, exponents_amplitude]
pick(panel, lid) = (panel == 1 ? kind('amplitude') : (kind('layers') || strcol(exponents_series)[1:11] eq 'amplitude 1')) && fixed(0) == lid
shift(lid) = lid == 1 ? 1.025 : 1
array marks[4] = [6, 4, 7, 5]
do for [panel = 1:2] {
  set lmargin at screen (panel == 1 ? 0.085 : 0.45)
  set rmargin at screen (panel == 1 ? 0.42 : 0.745)
  set label 1 (panel == 1 ? '(a)' : '(b)') at graph 0.04, 0.94
  set logscale x
  set ylabel (panel == 1 ? 'α' : '') offset 0.5
  if (panel == 2) { set format y '' } else { set format y '%g' }
  set xlabel (panel == 1 ? '{/:Italic A}/{/:Italic d}' : 'layers {/:Italic N} = 10 {/:Italic n d}^3')
  set xrange [panel == 1 ? 0.2 : 0.8 : panel == 1 ? 5 : 6.5]
  if (panel == 1) { set xtics (0.25, 0.5, 1, 2, 4) } else { set xtics (1, 2, 4, 5) }
  set key at graph 0.97, 0.05 right bottom Left reverse font ',11'
  plot 2 with lines linecolor rgb grey dashtype '-' title 'α = 2', \
       for [lid = 0:1] exponents using (pick(panel, lid) ? shift(lid) * column(panel_x[panel]) : NaN):(column(exponents_alpha)):(column(exponents_alpha_se)) \
         with yerrorbars pointtype marks[2 * panel - 1 + lid] pointsize 1 linewidth 1.3 linecolor rgb (lid ? vermillion : blue) title (lid ? 'lid fixed' : 'lid moving with the base')
}
unset logscale
set lmargin at screen 0.775
set rmargin at screen 0.98
set label 1 '(c)'
set xlabel ' '
set xrange [0.5:2.5]
set xtics ('{/:Italic e} = 0.7' 1, 'μ = 0.4' 2)
set key at graph 0.97, 0.05 right bottom Left reverse font ',10' samplen 1
place(n) = kind('e_p') ? 1 : kind('mu_p') ? 2 : NaN
plot 2 with lines linecolor rgb grey dashtype '-', \
     exponents using (place(0)):(column(exponents_alpha)):(column(exponents_alpha_se)) \
       with yerrorbars pointtype 9 pointsize 1 linewidth 1.3 linecolor rgb green, \
     keyentry with yerrorbars pointtype 0 linecolor rgb grey title '± one standard error'
unset multiplot
