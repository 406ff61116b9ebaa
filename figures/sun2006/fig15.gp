# Fig. 15: mean over replicas, our fits of Eq. (13), and the two curves the paper prints for each.
load 'style.gp'
# One replica has no spread.
known(n) = valid(n) ? column(n) : 0
set multiplot
set tmargin at screen 0.96
set bmargin at screen 0.14
set logscale y
set format y '10^{%T}'
set xrange [0:7]
set yrange [1e-4:2]
set xlabel '{/:Italic f = F}_n / <{/:Italic F}_n>'
set ylabel '{/:Italic P}({/:Italic f})'
set key right top Left reverse samplen 2 font ',12'
array sets[2] = ['pass 1', 'pass 2']
array names[2] = ['one pass', 'two passes']
do for [k = 1:2] {
  set lmargin at screen (k == 1 ? 0.095 : 0.585)
  set rmargin at screen (k == 1 ? 0.49 : 0.985)
  set label 1 (k == 1 ? '(a)' : '(b)') at graph 0.04, 0.08
  here(x) = strcol(pdf_set) eq sets[k] ? x : NaN
  plot pdf using (here(column(pdf_f))):(column(pdf_P) > 0 ? column(pdf_P) : NaN):(known(pdf_P_se)) with yerrorbars pointtype 8 pointsize 0.7 linecolor rgb grey title names[k], \
       pdf using (here(column(pdf_f))):(column(pdf_P_shifted_histogram_fit)) with lines linewidth 1.8 linecolor rgb blue title 'Eq. (13), least squares', \
       pdf using (here(column(pdf_f))):(column(pdf_P_shifted_likelihood_fit)) with lines linewidth 1.8 linecolor rgb green title 'Eq. (13), likelihood', \
       pdf using (here(column(pdf_f))):(column(pdf_P_paper)) with lines linewidth 1.4 dashtype '-' linecolor rgb 'black' title 'paper, whole range', \
       pdf using (here(column(pdf_f))):(column(pdf_P_paper_other)) with lines linewidth 1.4 dashtype '.' linecolor rgb 'black' title 'paper, all contacts shifted'
}
unset multiplot
