# Beyond the paper. Above: alpha over 4 <= W <= 16 as colour over N and e_p, one panel for each mu_p.
# Below: (left) every curve past its peak, over its W_f and height; (right) alpha over [W_f, W_2]
# against N.
load 'style.gp'
load 'series.gp'
set multiplot
set palette defined (0.4 '#440154', 0.8 '#3b528b', 1.2 '#21918c', 1.6 '#5ec962', 2.0 '#fde725')
set cbrange [0.4:2]
list = ' '
stats exponents using (note(strcol(exponents_mu_p))) nooutput
frictions = ''
do for [r = 0:words(list) - 1] { frictions = frictions . at_rank(list, r) }
n_mu = words(frictions)
of_fit(name, value) = strcol(exponents_fit) eq name ? value : NaN
of_mu(m, value) = strcol(exponents_mu_p) eq word(frictions, m) ? value : NaN
set tmargin at screen 0.95
set bmargin at screen 0.63
set xlabel '{/:Italic N}' offset 0, 0.6
set xrange [0.2:8.8]
set yrange [0.71:0.99]
set offsets 0, 0, 0, 0
do for [m = 1:n_mu] {
  set lmargin at screen 0.075 + 0.845 / n_mu * (m - 1)
  set rmargin at screen 0.065 + 0.845 / n_mu * m
  set title 'μ_p = ' . word(frictions, m) offset 0, -0.7
  set ylabel (m == 1 ? '{/:Italic e}_p' : '') offset 0.5
  set format y (m == 1 ? '%g' : '')
  if (m == n_mu) { set colorbox user origin screen 0.935, screen 0.63 size screen 0.015, screen 0.32; set cblabel 'α over 4 ≤ {/:Italic W} ≤ 16' offset 0.5 } else { unset colorbox }
  plot exponents using (of_fit('alpha-4-to-16', of_mu(m, column(exponents_N)))):(column(exponents_e_p)):(column(exponents_alpha)) \
         with points pointtype 5 pointsize 2.6 linecolor palette
}
unset title
set format y '%g'
unset colorbox

set tmargin at screen 0.52
set bmargin at screen 0.09
set lmargin at screen 0.075
set rmargin at screen 0.47
set logscale xy
set xrange [0.3:60]
set yrange [0.1:1.3]
set xlabel '{/:Italic W} / {/:Italic W}_f' offset 0, 0
set ylabel '{/:Italic T}_z/({/:Italic m V}_p^2) over its peak' offset 0.5
set key at graph 0.03, 0.04 left bottom Left reverse font ',11' samplen 1
list = ' '
stats collapse using (note(strcol(collapse_N))) nooutput
depths = ''
do for [r = 0:words(list) - 1] { depths = depths . at_rank(list, r) }
n = words(depths)
plot for [k = 1:n] collapse using (strcol(collapse_N) eq word(depths, k) ? column(collapse_W_over_W_f) : NaN):(column(collapse_y_over_peak)) \
       with points pointtype shape(k) pointsize 0.35 linecolor rgb tone(k, n) title '{/:Italic N} = ' . word(depths, k)

set lmargin at screen 0.56
set rmargin at screen 0.985
unset logscale
set xrange [0.2:8.8]
set yrange [0:2.2]
set xlabel '{/:Italic N}'
set ylabel 'α over [{/:Italic W}_f, {/:Italic W}_2]'
set key at graph 0.97, 0.97 right top Left reverse font ',11' samplen 1
list = ' '
stats exponents using (note(strcol(exponents_e_p))) nooutput
restitutions = ''
do for [r = 0:words(list) - 1] { restitutions = restitutions . at_rank(list, r) }
n = words(restitutions)
# Side by side: a little apart for each mu_p.
apart(c) = column(exponents_N) + 0.2 * column(exponents_mu_p)
plot for [k = 1:n] exponents using (strcol(exponents_e_p) eq word(restitutions, k) ? of_fit('alpha', apart(0)) : NaN):(column(exponents_alpha)):(column(exponents_alpha_se)) \
       with yerrorbars pointtype shape(k) pointsize 0.5 linecolor rgb tone(k, n) title '{/:Italic e}_p = ' . word(restitutions, k)
unset multiplot
