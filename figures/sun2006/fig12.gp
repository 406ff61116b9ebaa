# Fig. 12: (a) P(f) of all contacts, mean over replicas and its standard error, with the mean of the
# replicas' fits and both triples that the paper prints; (b) F(r).
load 'style.gp'
# One replica has no spread.
known(n) = valid(n) ? column(n) : 0
set multiplot
set tmargin at screen 0.96
set bmargin at screen 0.14
set lmargin at screen 0.095
set rmargin at screen 0.485
set label 1 '(a)' at graph 0.04, 0.08
set logscale y
set format y '10^{%T}'
set xrange [0:7]
set yrange [1e-4:2]
set xlabel '{/:Italic f = F}_n / <{/:Italic F}_n>'
set ylabel '{/:Italic P}({/:Italic f})'
set key right top Left reverse samplen 2 font ',12'
plot pdf using (column(pdf_f)):(column(pdf_P) > 0 ? column(pdf_P) : NaN):(known(pdf_P_se)) with yerrorbars pointtype 6 pointsize 0.6 linecolor rgb grey title 'all contacts', \
     pdf using (column(pdf_f)):(column(pdf_P_histogram_fit)) with lines linewidth 1.8 linecolor rgb blue title 'Eq. (11), least squares', \
     pdf using (column(pdf_f)):(column(pdf_P_likelihood_fit)) with lines linewidth 1.8 linecolor rgb green title 'Eq. (11), likelihood', \
     pdf using (column(pdf_f)):(column(pdf_P_paper)) with lines linewidth 1.4 dashtype '-' linecolor rgb 'black' title 'paper, caption ({/:Italic b} = 0.68)', \
     pdf using (column(pdf_f)):(column(pdf_P_paper_other)) with lines linewidth 1.4 dashtype '.' linecolor rgb 'black' title 'paper, text ({/:Italic b} = 0.83)'
unset logscale y
set format y '%g'
set lmargin at screen 0.585
set rmargin at screen 0.985
set label 1 '(b)' at graph 0.04, 0.94
set xrange [0:6]
set yrange [*:*]
set xlabel '{/:Italic r}/{/:Italic d}_0'
set ylabel '{/:Italic F}({/:Italic r})'
unset key
plot correlation using (column(correlation_r)):(column(correlation_F)):(known(correlation_F_se)) with yerrorlines pointtype 7 pointsize 0.5 linewidth 1.2 linecolor rgb blue
unset multiplot
