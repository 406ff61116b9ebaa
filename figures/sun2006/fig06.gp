# The large grain against friction between grains, and against the stiffness without it, initial height 43 d0, at integer T.
load 'style.gp'
load 'rise.gp'
stats friction_rise using (column(friction_rise_grains)) nooutput
set label 8 sprintf('%d small grains', STATS_max) at screen 0.28, 0.975 center font ',11'
stats stiffness_rise using (column(stiffness_rise_grains)) nooutput
set label 9 sprintf('%d small grains', STATS_max) at screen 0.78, 0.975 center font ',11'
# Stiffnesses that have not been run say so.
array missing[3]
do for [v = 1:3] {
  stats stiffness using (strcol(stiffness_k_n) eq word('2e5 6e5 2e6', v) ? 1 : 0) nooutput
  missing[v] = STATS_sum == 0
}
set multiplot
set lmargin at screen 0.07
set rmargin at screen 0.485
set label 1 '(a)' at graph 0.93, 0.06
array values[4] = ['0.1', '0.3', '0.5', '0.8']
array labels[4] = ['{/Symbol m} = 0.1', '{/Symbol m} = 0.3', '{/Symbol m} = 0.5', '{/Symbol m} = 0.8']
plot for [v = 1:4] for [r = 1:6] friction using (one_of(friction_mu, values[v], r, friction_replicate) ? column(friction_T) : NaN):(column(friction_large_height)) \
       with linespoints pointtype 7 pointsize 0.35 linewidth 1.4 linecolor rgb hues[v], \
     for [v = 1:4] keyentry with lines linewidth 2 linecolor rgb hues[v] title labels[v]
set lmargin at screen 0.575
set rmargin at screen 0.985
set label 1 '(b)' at graph 0.93, 0.06
array values[3] = ['2e5', '6e5', '2e6']
array labels[3] = ['{/Symbol m} = 0, {/:Italic k}_n = 2 10^5', '{/Symbol m} = 0, {/:Italic k}_n = 6 10^5', '{/Symbol m} = 0, {/:Italic k}_n = 2 10^6']
do for [v = 1:3] { if (missing[v]) { labels[v] = labels[v].': not computed' } }
plot for [v = 1:3] for [r = 1:6] stiffness using (one_of(stiffness_k_n, values[v], r, stiffness_replicate) ? column(stiffness_T) : NaN):(column(stiffness_large_height)) \
       with linespoints pointtype 7 pointsize 0.35 linewidth 1.4 linecolor rgb hues[v], \
     for [v = 1:3] keyentry with lines linewidth 2 linecolor rgb hues[v] title labels[v]
unset multiplot
