# The large grain against the stiffness and with linear and Hertzian contacts, initial height 43 d0, at integer T.
load 'style.gp'
load 'rise.gp'
stats stiffness_rise using (column(stiffness_rise_grains)) nooutput
set label 8 sprintf('%d small grains', STATS_max) at screen 0.28, 0.975 center font ',11'
stats law_rise using (column(law_rise_grains)) nooutput
set label 9 sprintf('%d small grains', STATS_max) at screen 0.78, 0.975 center font ',11'
# Stiffnesses that have not been run say so.
array missing[4]
do for [v = 1:4] {
  stats stiffness using (strcol(stiffness_k_n) eq word('1e5 2e5 6e5 2e6', v) ? 1 : 0) nooutput
  missing[v] = STATS_sum == 0
}
set multiplot
set lmargin at screen 0.07
set rmargin at screen 0.485
set label 1 '(a)' at graph 0.93, 0.06
array values[4] = ['1e5', '2e5', '6e5', '2e6']
array labels[4] = ['{/:Italic k}_n = 10^5', '{/:Italic k}_n = 2 10^5', '{/:Italic k}_n = 6 10^5', '{/:Italic k}_n = 2 10^6']
do for [v = 1:4] { if (missing[v]) { labels[v] = labels[v].': not computed' } }
plot for [v = 1:4] for [r = 1:6] stiffness using (one_of(stiffness_k_n, values[v], r, stiffness_replicate) ? column(stiffness_T) : NaN):(column(stiffness_large_height)) \
       with linespoints pointtype 7 pointsize 0.35 linewidth 1.4 linecolor rgb hues[v], \
     for [v = 1:4] keyentry with lines linewidth 2 linecolor rgb hues[v] title labels[v]
set lmargin at screen 0.575
set rmargin at screen 0.985
set label 1 '(b)' at graph 0.93, 0.06
array values[2] = ['linear_spring_dashpot', 'hertz']
array labels[2] = ['linear', 'Hertz']
plot for [v = 1:2] for [r = 1:6] law using (one_of(law_law, values[v], r, law_replicate) ? column(law_T) : NaN):(column(law_large_height)) \
       with linespoints pointtype 7 pointsize 0.35 linewidth 1.4 linecolor rgb hues[v], \
     for [v = 1:2] keyentry with lines linewidth 2 linecolor rgb hues[v] title labels[v]
unset multiplot
